#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace offstage::test {

/// A PNG of any kind, from its samples: the encoder that the strict reader is held to.
struct PngSpec {
  int width = 1;
  int height = 1;
  int depth = 8;
  int color = 2; ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool interlaced = false;
  int filter = 0;             ///< of every row; 5: all in turn
  int idatPieces = 1;         ///< chunks that the pixel data is cut into
  std::string palette{};      ///< PLTE
  std::string transparency{}; ///< tRNS
  std::string before{};       ///< chunks between IHDR and PLTE
};

/// Sample `channel` of a pixel, 0 … 2^depth − 1.
using Samples = std::function<unsigned(int x, int y, int channel)>;

int channelsOf(const PngSpec& spec);
std::string makePng(const PngSpec& spec, const Samples& samples);

/// A chunk with its length and CRC.
std::string pngChunk(const std::string& type, const std::string& data);
/// The four bytes of a number, highest first.
std::string bigEndian(std::uint32_t value);
/// A zlib stream.
std::string deflated(const std::string& bytes);
/// IHDR's 13 bytes.
std::string pngHeader(std::uint32_t width, std::uint32_t height, int depth, int color, int interlaced = 0);
/// Signature, IHDR, the given chunks.
std::string pngOf(const std::string& header, const std::string& chunks);

} // namespace offstage::test
