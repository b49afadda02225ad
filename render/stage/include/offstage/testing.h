#pragma once

/// GoogleTest matchers for what an exercise draws and computes. A test program that includes this links
/// Offstage::offstage and GTest::gmock:
///
///     TEST(Bounce, LooksRight) {
///       EXPECT_THAT(offstage::exerciseFrame<Bounce>(2.5), offstage::MatchesGolden("bounce@2.5s"));
///     }
///
/// Goldens are PNGs in the folder "goldens" (see goldenFolder()). OFFSTAGE_UPDATE_GOLDENS=1 in the
/// environment rewrites those that are missing or do not hold, and makes the run fail with a list of them, so
/// that nothing passes by accident.

#include "render/compare/golden_check.h"
#include "render/raster/frame.h"
#include "render/stage/frame_at.h"
#include "src/sim/vec.h"

#include <cmath>
#include <ostream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {

/// What a failing test prints of a frame, instead of its bytes.
inline void PrintTo(const Frame& frame, std::ostream* out) {
  *out << "a frame of " << frame.width << "x" << frame.height << " px";
}

/// See MatchesGolden().
class GoldenMatcher {
public:
  using is_gtest_matcher = void;
  GoldenMatcher(std::string name, Tolerance tolerance)
      : name_(std::move(name)), tolerance_(std::move(tolerance)) {}

  bool MatchAndExplain(const Frame& frame, std::ostream* out) const {
    const FrameCheck check = checkGolden(frame, name_, tolerance_);
    if (out != nullptr) *out << '\n' << check.text;
    return check.passed;
  }
  void DescribeTo(std::ostream* out) const { *out << "matches the golden " << name_; }
  void DescribeNegationTo(std::ostream* out) const { *out << "differs from the golden " << name_; }

private:
  std::string name_;
  Tolerance tolerance_;
};

/// Matches a Frame that is the golden NAME.png; without a tolerance to the last pixel. See checkGolden().
inline GoldenMatcher MatchesGolden(std::string name, Tolerance tolerance = {}) {
  return {std::move(name), std::move(tolerance)};
}

/// See IsSameFrame().
class SameFrameMatcher {
public:
  using is_gtest_matcher = void;
  SameFrameMatcher(Frame expected, Tolerance tolerance)
      : expected_(std::move(expected)), tolerance_(std::move(tolerance)) {}

  bool MatchAndExplain(const Frame& frame, std::ostream* out) const {
    const FrameCheck check = checkSameFrame(expected_, frame, tolerance_);
    if (out != nullptr) *out << '\n' << check.text;
    return check.passed;
  }
  void DescribeTo(std::ostream* out) const { *out << "is the same frame"; }
  void DescribeNegationTo(std::ostream* out) const { *out << "is another frame"; }

private:
  Frame expected_;
  Tolerance tolerance_;
};

/// Matches a Frame with the same pixels; without a tolerance to the last one.
inline SameFrameMatcher IsSameFrame(Frame expected, Tolerance tolerance = {}) {
  return {std::move(expected), std::move(tolerance)};
}

/// See IsNear().
class NearMatcher {
public:
  using is_gtest_matcher = void;
  NearMatcher(Vec2 expected, double eps) : expected_(std::move(expected)), eps_(eps) {}

  bool MatchAndExplain(const Vec2& vec, std::ostream* out) const {
    const double distance = (vec - expected_).norm();
    if (out != nullptr) {
      const auto precision = out->precision(17);
      *out << "which is (" << vec.x() << ", " << vec.y() << "), " << distance << " away";
      out->precision(precision);
    }
    return distance <= eps_; // NaN is near nothing
  }
  void DescribeTo(std::ostream* out) const { describe(out, "at most "); }
  void DescribeNegationTo(std::ostream* out) const { describe(out, "more than "); }

private:
  void describe(std::ostream* out, const char* bound) const {
    const auto precision = out->precision(17);
    *out << "is " << bound << eps_ << " away from (" << expected_.x() << ", " << expected_.y() << ")";
    out->precision(precision);
  }

  Vec2 expected_;
  double eps_;
};

/// Matches a Vec2 whose distance from `expected` is at most `eps`, in the vector's unit.
inline NearMatcher IsNear(const Vec2& expected, double eps) {
  return {expected, eps};
}

/// Makes a run that rewrote goldens fail, whatever its tests say.
class RewrittenGoldensFail : public ::testing::Environment {
public:
  void TearDown() override {
    if (rewrittenGoldens().empty()) return;
    std::string list;
    for (const std::filesystem::path& file : rewrittenGoldens()) list += "\n  " + file.string();
    ADD_FAILURE() << "OFFSTAGE_UPDATE_GOLDENS=1 rewrote, so this run does not pass:" << list
                  << "\nLook at them, and run again without it.";
  }
};

/// Registered by including this header. GoogleTest owns it.
inline ::testing::Environment* const kRewrittenGoldensFail =
    ::testing::AddGlobalTestEnvironment(new RewrittenGoldensFail);

} // namespace offstage
