#pragma once

#include <cstdint>
#include <span>

namespace offstage {

/// Whether every Huffman table (DHT) of a JPEG file has at most 256 codes, as ITU-T T.81, B.2.4.2 demands.
/// The stb_image that Debian 12 packages (2.27) writes past its tables when one has more. True for what is no
/// JPEG.
bool jpegTablesFit(std::span<const std::uint8_t> file);

} // namespace offstage
