#pragma once

#include "render/compare/bit_plane.h"
#include "render/draw/pixel_rows.h"
#include "src/scene/tolerance.h"

#include <vector>

namespace offstage {

/// The pixels of a picture of this size that the tolerance takes out of the comparison: its regions and what
/// its masks paint dark (below mid-grey, over white). Empty when there are none. Throws Error(BadInput) when
/// a mask cannot be read or has another size.
BitPlane ignoredPixels(const Tolerance& tolerance, int width, int height);

/// The actual picture with every ignored pixel taken from the expected one, for measures that know of no
/// ignored pixels. Both must outlive it.
class IgnoringRows final : public PixelRows {
public:
  IgnoringRows(const PixelRows& actual, const PixelRows& expected, const BitPlane& ignored);

  [[nodiscard]] int width() const override { return actual_.width(); }
  [[nodiscard]] int height() const override { return actual_.height(); }
  [[nodiscard]] bool deep() const override { return actual_.deep() || expected_.deep(); }
  const std::uint8_t* row8(int y, std::uint8_t* buffer) const override;
  void row16(int y, std::uint16_t* buffer) const override;
  [[nodiscard]] std::span<const std::uint8_t> stored(int y) const override { return actual_.stored(y); }
  [[nodiscard]] const std::string& layout() const override { return layout_; }

private:
  const PixelRows& actual_;
  const PixelRows& expected_;
  const BitPlane& ignored_;
  std::string layout_; ///< one that no other picture has: stored rows still hold the ignored pixels
};

} // namespace offstage
