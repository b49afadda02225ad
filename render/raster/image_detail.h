#pragma once

#include "render/draw/image.h"

#include <vector>

namespace offstage {

/// How much of an image is lost when it is seen through pixels of 2^k by 2^k texels: element k is the root
/// mean square deviation of its premultiplied channels from the means of such blocks, 0 … 128 (of 255). A
/// fine checkerboard has 128 from the size of its squares doubled on, a smooth picture stays near 0. As many
/// elements as it takes until one block holds the whole image.
std::vector<double> imageDetail(const Image& image);

} // namespace offstage
