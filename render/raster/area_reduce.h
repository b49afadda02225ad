#pragma once

#include "render/draw/image.h"

namespace offstage {

/// The image at width×height, at most its own size: each pixel is the mean of the area of the image that it
/// covers, in premultiplied colours, rounded to nearest. Returns RGBA, premultiplied, 4 bytes a pixel.
std::vector<std::uint8_t> areaReduce(const Image& image, int width, int height);

} // namespace offstage
