#include "render/raster/ground_check.h"

namespace offstage {
namespace {

/// What llvmpipe keeps of the ground when it blends.
constexpr unsigned keptOf(unsigned ground, unsigned alpha) {
  const unsigned product = ground * (255U - alpha);
  return (product + (product >> 8U) + 128U) >> 8U;
}

constexpr float partOf(unsigned ground) {
  return static_cast<float>(ground) * (257.0F / 65536.0F);
}

/// render/raster/shader_sources.cpp's onGround() for a source of no colour. No product lies nearer to a half
/// than 3e-5, which a fused multiplication and addition would not make up for.
constexpr bool shaderKeepsTheSame() {
  constexpr float kWhole = 8388608.0F; // 2^23
  for (unsigned ground = 0; ground < 256; ++ground) {
    for (unsigned alpha = 0; alpha < 256; ++alpha) {
      const float kept = partOf(ground) * static_cast<float>(255U - alpha);
      if ((kept + kWhole) - kWhole != static_cast<float>(keptOf(ground, alpha))) return false;
    }
  }
  return true;
}
static_assert(shaderKeepsTheSame());

Instance pointInstance(int x, int y, int side, Rgba8 color) {
  Instance instance;
  instance.quad = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                   static_cast<std::uint16_t>(x + side), static_cast<std::uint16_t>(y + side)};
  instance.color = {color.r, color.g, color.b, color.a};
  return instance;
}

} // namespace

std::array<float, 4> groundOf(Rgba8 opaque) {
  return {partOf(opaque.r), partOf(opaque.g), partOf(opaque.b), 0.0F};
}

bool GroundCheck::possible(const Framebuffer& framebuffer, Rgba8 ground) {
  return ground.a == 255 && framebuffer.width() >= kTrial.right && framebuffer.height() >= kTrial.bottom;
}

std::optional<bool> GroundCheck::known(Rgba8 ground) const {
  if (ground_ != ground) return std::nullopt;
  return exact_;
}

void GroundCheck::run(const Framebuffer& framebuffer, Rgba8 ground, const PatternTexture& patterns,
                      DrawQueue& queue) {
  const ProgramKind pixels{Coverage::Whole, PaintSource::Color, Footprint::Point};
  queue.clear();
  queue.add(pixels, pointInstance(0, 0, kTrial.right, ground));
  queue.paint(patterns);
  queue.clear();
  for (int alpha = 0; alpha < 256; ++alpha) {
    const Rgba8 nothing{0, 0, 0, static_cast<std::uint8_t>(alpha)};
    queue.add(pixels, pointInstance(alpha % kTrial.right, alpha / kTrial.right, 1, nothing));
  }
  queue.paint(patterns, true);
  queue.clear();

  std::array<std::uint8_t, 4UL * 256UL> result{};
  framebuffer.readStored(kTrial, result.data(), kTrial.right);
  ground_ = ground;
  exact_ = true;
  for (unsigned alpha = 0; alpha < 256; ++alpha) {
    const std::size_t i = 4UL * alpha;
    exact_ = exact_ && result[i] == keptOf(ground.r, alpha) && result[i + 1] == keptOf(ground.g, alpha) &&
             result[i + 2] == keptOf(ground.b, alpha) && result[i + 3] == 255;
  }
}

} // namespace offstage
