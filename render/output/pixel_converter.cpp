#include "render/output/pixel_converter.h"

#include "render/output/frame_check.h"
#include "render/output/yuv.h"

#include <cstring>
#include <stdexcept>

namespace offstage {
namespace {

const std::uint8_t* rowOf(const Frame& frame, int row) {
  return frame.rgba.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) * 4;
}

std::uint8_t* rowOf(const AVFrame& picture, int plane, int row) {
  return picture.data[plane] + static_cast<std::ptrdiff_t>(row) * picture.linesize[plane];
}

class Yuv420 : public PixelConverter {
public:
  void convert(const Frame& frame, AVFrame& picture) override {
    converter_.convert(frame, {picture.data[0], picture.data[1], picture.data[2], picture.linesize[0],
                               picture.linesize[1], picture.linesize[2]});
  }

private:
  Yuv420Converter converter_;
};

/// The alpha plane has the size of luma; padding repeats its last column and row.
class Yuva420 : public Yuv420 {
public:
  void convert(const Frame& frame, AVFrame& picture) override {
    Yuv420::convert(frame, picture);
    for (int row = 0; row < picture.height; ++row) {
      const std::uint8_t* from = rowOf(frame, row < frame.height ? row : frame.height - 1);
      std::uint8_t* to = rowOf(picture, 3, row);
      for (int x = 0; x < frame.width; ++x) to[x] = from[4 * x + 3];
      if (picture.width > frame.width) to[frame.width] = to[frame.width - 1];
    }
  }
};

// Weights with 20 fractional bits.
constexpr int kBits = 20;
constexpr double kRed = 0.2126;
constexpr double kBlue = 0.0722;
constexpr double kGreen = 1.0 - kRed - kBlue;
constexpr std::int32_t weight(double value) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): of small positive numbers; std::lround is not constexpr
  return static_cast<std::int32_t>(value * (1 << kBits) / 255.0 + 0.5);
}
constexpr std::int32_t kYRed = weight(876.0 * kRed);
constexpr std::int32_t kYGreen = weight(876.0 * kGreen);
constexpr std::int32_t kYBlue = weight(876.0 * kBlue);
constexpr std::int32_t kCbRed = weight(896.0 * kRed / 1.8556);
constexpr std::int32_t kCbGreen = weight(896.0 * kGreen / 1.8556);
constexpr std::int32_t kCbBlue = kCbRed + kCbGreen; // greys have no colour, to the bit
constexpr std::int32_t kCrGreen = weight(896.0 * kGreen / 1.5748);
constexpr std::int32_t kCrBlue = weight(896.0 * kBlue / 1.5748);
constexpr std::int32_t kCrRed = kCrGreen + kCrBlue;
constexpr std::int32_t kAlpha = weight(1023.0);

/// 10 bits: Y = 876 E'Y + 64, C = 896 E'C + 512 (ITU-R BT.709-6, section 3), in integers with 20 fractional
/// bits.
class Yuva444In10Bits : public PixelConverter {
public:
  void convert(const Frame& frame, AVFrame& picture) override {
    requireWholeFrame(frame);
    for (int row = 0; row < frame.height; ++row) {
      const std::uint8_t* from = rowOf(frame, row);
      std::uint8_t* y = rowOf(picture, 0, row);
      std::uint8_t* u = rowOf(picture, 1, row);
      std::uint8_t* v = rowOf(picture, 2, row);
      std::uint8_t* a = rowOf(picture, 3, row);
      for (int x = 0; x < frame.width; ++x, from += 4) {
        const std::int32_t red = from[0];
        const std::int32_t green = from[1];
        const std::int32_t blue = from[2];
        store(y, x, kYRed * red + kYGreen * green + kYBlue * blue + (64 << kBits));
        store(u, x, kCbBlue * blue - kCbRed * red - kCbGreen * green + (512 << kBits));
        store(v, x, kCrRed * red - kCrGreen * green - kCrBlue * blue + (512 << kBits));
        store(a, x, kAlpha * from[3]);
      }
    }
  }

private:
  static void store(std::uint8_t* row, int x, std::int32_t value) {
    const auto sample = static_cast<std::uint16_t>((value + (1 << (kBits - 1))) >> kBits);
    std::memcpy(row + static_cast<std::ptrdiff_t>(x) * 2, &sample, sizeof sample);
  }
};

/// Red and blue change places.
class Bgr : public PixelConverter {
public:
  void convert(const Frame& frame, AVFrame& picture) override {
    requireWholeFrame(frame);
    for (int row = 0; row < frame.height; ++row) {
      const std::uint8_t* from = rowOf(frame, row);
      std::uint8_t* to = rowOf(picture, 0, row);
      for (std::ptrdiff_t x = 0; x < frame.width; ++x) {
        to[4 * x] = from[4 * x + 2];
        to[4 * x + 1] = from[4 * x + 1];
        to[4 * x + 2] = from[4 * x];
        to[4 * x + 3] = from[4 * x + 3];
      }
    }
  }
};

} // namespace

std::unique_ptr<PixelConverter> makePixelConverter(AVPixelFormat format) {
  switch (format) {
  case AV_PIX_FMT_YUV420P:
    return std::make_unique<Yuv420>();
  case AV_PIX_FMT_YUVA420P:
    return std::make_unique<Yuva420>();
  case AV_PIX_FMT_YUVA444P10:
    return std::make_unique<Yuva444In10Bits>();
  case AV_PIX_FMT_BGR0:
  case AV_PIX_FMT_BGRA:
    return std::make_unique<Bgr>();
  default:
    throw std::logic_error("no converter to this pixel format");
  }
}

} // namespace offstage
