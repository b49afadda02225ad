#pragma once

#include <cstddef>
#include <cstdint>

namespace offstage {

// What a scene may ask for at most. The bounds lie far above any lecture's needs; they are there so that a
// hostile or mistyped file is refused with a message instead of taking the machine's memory or days of time.
// scenes/README.md lists them.

inline constexpr std::size_t kMaxSceneBytes = std::size_t{8} << 20U;
inline constexpr std::size_t kMaxTableBytes = std::size_t{256} << 20U; ///< of a [[bodies]] table
inline constexpr std::int64_t kMaxSide = 16384;     ///< px: width and height, of the scene and of its output
inline constexpr double kMaxScale = 64.0;           ///< output pixels per scene pixel
inline constexpr double kMaxDuration = 86400.0;     ///< s
inline constexpr double kMaxFps = 1e6;              ///< 1/s
inline constexpr double kMinStep = 1e-6;            ///< s: [clock] dt
inline constexpr double kMaxStep = 10.0;            ///< s
inline constexpr std::int64_t kMaxSubsteps = 10000; ///< steps per frame
inline constexpr std::size_t kMaxForces = 10000;    ///< [[force]] tables of a scene
inline constexpr std::size_t kMaxGroupsOfAll = 256; ///< that "*" of a [[collide]] may stand for
inline constexpr std::size_t kMaxExpressionLength = 4096; ///< characters
inline constexpr std::size_t kMaxTexts = 1000;            ///< [[text]] tables of a scene
inline constexpr std::size_t kMaxTextBytes = 4096;        ///< of one text or formula
inline constexpr double kLeastTextSize = 4.0;             ///< px: less cannot be read
inline constexpr double kMostTextSize = 1024.0;           ///< px
inline constexpr std::size_t kMaxDiagnostics = 1000;      ///< errors that one run lists

} // namespace offstage
