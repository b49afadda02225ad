#pragma once

#include "render/draw/pixel_rows.h"
#include "render/raster/frame.h"

#include <algorithm>
#include <utility>

namespace offstage {

/// A whole frame (frame_check.h) as PixelRows.
class FrameRows final : public PixelRows {
public:
  explicit FrameRows(const Frame& frame) : frame_(frame) {} ///< the frame must outlive it
  explicit FrameRows(Frame&& frame) : own_(std::move(frame)), frame_(own_) {}
  ~FrameRows() override = default;

  [[nodiscard]] int width() const override { return frame_.width; }
  [[nodiscard]] int height() const override { return frame_.height; }
  [[nodiscard]] bool deep() const override { return false; }
  const std::uint8_t* row8(int y, std::uint8_t* /*buffer*/) const override { return stored(y).data(); }
  void row16(int y, std::uint16_t* buffer) const override {
    for (const std::uint8_t value : stored(y)) *buffer++ = static_cast<std::uint16_t>(value * 257);
  }
  [[nodiscard]] std::span<const std::uint8_t> stored(int y) const override {
    const std::size_t bytes = 4UL * static_cast<std::size_t>(frame_.width);
    return {frame_.rgba.data() + static_cast<std::size_t>(y) * bytes, bytes};
  }
  [[nodiscard]] const std::string& layout() const override { return kRgba8Layout; }

private:
  Frame own_;
  const Frame& frame_;
};

/// All rows as a frame of 8 bits a channel.
inline Frame toFrame(const PixelRows& rows) {
  Frame frame;
  frame.width = rows.width();
  frame.height = rows.height();
  const std::size_t bytes = 4UL * static_cast<std::size_t>(frame.width);
  frame.rgba.resize(bytes * static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* to = frame.rgba.data() + static_cast<std::size_t>(y) * bytes;
    const std::uint8_t* from = rows.row8(y, to);
    if (from != to) std::copy_n(from, bytes, to);
  }
  return frame;
}

} // namespace offstage
