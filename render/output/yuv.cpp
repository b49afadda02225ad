#include "render/output/yuv.h"

#include "render/output/frame_check.h"

#include <algorithm>
#include <array>

namespace offstage {

namespace {

// A weight w is held as w·2^16. A channel value is held shifted up to 16 bits, and the high half of the
// 32-bit product is the contribution in units of 1/256 of a level, rounded down. Every loop is thereby one in
// 16-bit lanes, which compilers vectorise on any x86-64 (pmulhuw).

constexpr double kRed = 0.2126;
constexpr double kBlue = 0.0722;
constexpr double kGreen = 1.0 - kRed - kBlue;

/// Rounded to the nearest 1/65536; 0 ≤ value < 1.
constexpr std::uint16_t weight(double value) {
  return static_cast<std::uint16_t>((static_cast<std::uint32_t>(value * 131072.0) + 1) / 2);
}

constexpr double kLuma = 219.0 / 255.0;
constexpr std::uint16_t kYRed = weight(kLuma * kRed);
constexpr std::uint16_t kYGreen = weight(kLuma * kGreen);
constexpr std::uint16_t kYBlue = weight(kLuma * kBlue);

constexpr double kCb = 224.0 / 255.0 / (2.0 * (1.0 - kBlue)); // 1.8556 = 2 (1 − 0.0722)
constexpr double kCr = 224.0 / 255.0 / (2.0 * (1.0 - kRed));  // 1.5748 = 2 (1 − 0.2126)
constexpr std::uint16_t kCbRed = weight(kCb * kRed);
constexpr std::uint16_t kCbGreen = weight(kCb * kGreen);
constexpr std::uint16_t kCbBlue = kCbRed + kCbGreen; // greys have no colour, to the bit
constexpr std::uint16_t kCrGreen = weight(kCr * kGreen);
constexpr std::uint16_t kCrBlue = weight(kCr * kBlue);
constexpr std::uint16_t kCrRed = kCrGreen + kCrBlue;

// The offset, half a level for rounding, and the mean of what rounding down has taken from the contributions
// (half a unit each; three add up in Y, and in Cb and Cr two negative ones outweigh a positive one by half a
// unit).
constexpr std::uint16_t kYOffset = 16 * 256 + 128 + 1;
constexpr std::uint16_t kCOffset = 128 * 256 + 128 - 1;

inline std::uint16_t highHalf(std::uint16_t a, std::uint16_t b) {
  return static_cast<std::uint16_t>((static_cast<std::uint32_t>(a) * b) >> 16U);
}

void convertLumaRow(const std::uint8_t* __restrict rgba, std::uint8_t* __restrict y, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) {
    const auto red = static_cast<std::uint16_t>(rgba[4 * x] << 8U);
    const auto green = static_cast<std::uint16_t>(rgba[4 * x + 1] << 8U);
    const auto blue = static_cast<std::uint16_t>(rgba[4 * x + 2] << 8U);
    const auto sum = static_cast<std::uint16_t>(highHalf(red, kYRed) + highHalf(green, kYGreen) +
                                                highHalf(blue, kYBlue) + kYOffset);
    y[x] = static_cast<std::uint8_t>(sum >> 8U);
  }
}

/// red[x] = upper R + lower R at column x, and so on.
void sumRows(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict lower,
             std::uint16_t* __restrict red, std::uint16_t* __restrict green, std::uint16_t* __restrict blue,
             std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) {
    red[x] = static_cast<std::uint16_t>(upper[4 * x] + lower[4 * x]);
    green[x] = static_cast<std::uint16_t>(upper[4 * x + 1] + lower[4 * x + 1]);
    blue[x] = static_cast<std::uint16_t>(upper[4 * x + 2] + lower[4 * x + 2]);
  }
}

/// The eightfold mean of columns 2i − 1 … 2i + 1, shifted up to 16 bits. `sums` begins with column −1.
inline std::uint16_t filtered(const std::uint16_t* sums, std::size_t i) {
  return static_cast<std::uint16_t>((sums[2 * i] + 2 * sums[2 * i + 1] + sums[2 * i + 2]) << 5U);
}

void convertChromaRow(const std::uint16_t* __restrict red, const std::uint16_t* __restrict green,
                      const std::uint16_t* __restrict blue, std::uint8_t* __restrict u,
                      std::uint8_t* __restrict v, std::size_t width) {
  for (std::size_t i = 0; i < width; ++i) {
    const std::uint16_t r = filtered(red, i);
    const std::uint16_t g = filtered(green, i);
    const std::uint16_t b = filtered(blue, i);
    const auto cb = static_cast<std::uint16_t>(kCOffset + highHalf(b, kCbBlue) - highHalf(r, kCbRed) -
                                               highHalf(g, kCbGreen));
    const auto cr = static_cast<std::uint16_t>(kCOffset + highHalf(r, kCrRed) - highHalf(g, kCrGreen) -
                                               highHalf(b, kCrBlue));
    u[i] = static_cast<std::uint8_t>(cb >> 8U);
    v[i] = static_cast<std::uint8_t>(cr >> 8U);
  }
}

} // namespace

void Yuv420Converter::convert(const Frame& frame, const Yuv420Planes& planes) {
  requireWholeFrame(frame);
  const auto evenWidth = static_cast<std::size_t>(evenSize(frame.width));
  for (auto* sums : {&red_, &green_, &blue_}) sums->resize(evenWidth + 2);
  if (frame.id != 0 && frame.id == converted_) return; // shown twice
  if (frame.base != 0 && frame.base == converted_) {
    for (const PixelRect& rect : frame.damage) convert(frame, planes, affected(frame, rect));
  } else {
    convert(frame, planes, {0, 0, evenSize(frame.width), evenSize(frame.height)});
  }
  converted_ = frame.id;
}

PixelRect Yuv420Converter::affected(const Frame& frame, const PixelRect& damage) {
  // A chroma sample on column 2i takes from 2i − 1 to 2i + 1, so a pixel counts on both sides of it.
  return {damage.left / 2 * 2, damage.top / 2 * 2, std::min(damage.right / 2 * 2 + 2, evenSize(frame.width)),
          std::min(evenSize(damage.bottom), evenSize(frame.height))};
}

void Yuv420Converter::convert(const Frame& frame, const Yuv420Planes& planes, const PixelRect& rect) {
  const auto width = static_cast<std::size_t>(frame.width);
  const auto left = static_cast<std::size_t>(rect.left);
  const auto right = static_cast<std::size_t>(rect.right);
  const std::size_t end = std::min(right, width); // of the columns that the frame has
  const std::size_t sumsBegin = left == 0 ? 0 : left - 1;
  const std::size_t sumsEnd = std::min(right + 1, width);
  for (int row = rect.top; row < rect.bottom; row += 2) {
    const std::uint8_t* upper = frame.rgba.data() + static_cast<std::size_t>(row) * width * 4;
    const std::uint8_t* lower = row + 1 < frame.height ? upper + width * 4 : upper;
    std::uint8_t* y = planes.y + row * planes.yStride;
    convertLumaRow(upper + 4 * left, y + left, end - left);
    convertLumaRow(lower + 4 * left, y + planes.yStride + left, end - left);
    if (end < right) {
      for (std::uint8_t* luma : {y, y + planes.yStride}) luma[end] = luma[end - 1];
    }

    sumRows(upper + 4 * sumsBegin, lower + 4 * sumsBegin, red_.data() + 1 + sumsBegin,
            green_.data() + 1 + sumsBegin, blue_.data() + 1 + sumsBegin, sumsEnd - sumsBegin);
    for (auto* sums : {&red_, &green_, &blue_}) {
      if (left == 0) sums->front() = (*sums)[1];
      if (right + 1 > width)
        std::fill(sums->begin() + static_cast<std::ptrdiff_t>(width) + 1, sums->end(), (*sums)[width]);
    }
    const std::ptrdiff_t chroma = rect.left / 2;
    const std::ptrdiff_t chromaRow = row / 2;
    convertChromaRow(red_.data() + left, green_.data() + left, blue_.data() + left,
                     planes.u + chromaRow * planes.uStride + chroma,
                     planes.v + chromaRow * planes.vStride + chroma, (right - left) / 2);
  }
}

} // namespace offstage
