#pragma once

#include "render/draw/picture.h"
#include "render/raster/gl_device.h"
#include "render/raster/instance.h"

#include <map>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace offstage {

/// The texels of every image and mask that a canvas has drawn, in one buffer texture, so that primitives with
/// different images share a draw call. Each image is uploaded once, and again at half the width or height (by
/// area) the first time that it is drawn that small. Images are kept alive, because they are known by their
/// address.
class PatternTexture {
public:
  explicit PatternTexture(std::shared_ptr<GlDevice> device);
  ~PatternTexture();
  PatternTexture(const PatternTexture&) = delete;
  PatternTexture& operator=(const PatternTexture&) = delete;

  /// Sets `instance`'s texels and texelMap for a pattern, from its origin, which is set already. True when
  /// the image is drawn smaller than the chosen level along an axis (PaintSource::Reduced). Throws
  /// Error(BadInput) when the images together are larger than the driver's buffer textures.
  bool place(const PlacedPattern& pattern, Instance& instance);

  /// Sets `instance`'s texels for a mask: coverage is a texel's alpha. Throws as above.
  void place(const std::shared_ptr<const Mask>& mask, Instance& instance);

  void bind() const;

private:
  struct Level {
    int first = 0; ///< texel in the buffer
    int width = 0;
    int height = 0;
  };
  using Key = std::tuple<const Image*, int, int>; ///< image, width, height

  const Level& level(const std::shared_ptr<const Image>& image, int width, int height);
  /// Whether the image has detail that pixels of `reduction` texels cannot show.
  bool losesDetail(const std::shared_ptr<const Image>& image, double reduction);
  /// Uploads `texels` texels of 4 bytes; returns where the first stands.
  int append(const std::vector<std::uint8_t>& rgba);
  void reserve(int texels);

  std::shared_ptr<GlDevice> device_;
  std::map<Key, Level> levels_;
  std::map<const Image*, std::shared_ptr<const Image>> images_;
  std::map<const Image*, std::vector<double>> details_; ///< imageDetail
  struct PlacedMask {
    std::shared_ptr<const Mask> mask;
    int first = 0; ///< texel in the buffer
  };
  std::unordered_map<const Mask*, PlacedMask> masks_;
  GLuint texture_ = 0;
  GLuint buffer_ = 0;
  int used_ = 0;     ///< texels
  int capacity_ = 0; ///< texels
};

} // namespace offstage
