#pragma once

#include "render/compare/report.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace offstage {

/// The pictures of a sequence's worst frames, as many as a report can show: the first differing one always,
/// then the most severe.
class WorstFrames {
public:
  explicit WorstFrames(std::size_t most) : most_(most) {}

  [[nodiscard]] bool wants(double severity) const {
    return kept_.size() < most_ || (most_ > 0 && severity > kept_.back().severity);
  }

  void add(const std::string& name, double severity, ReportPictures pictures) {
    const bool first = kept_.empty();
    Kept frame{name, severity, first, std::move(pictures)};
    kept_.insert(std::ranges::upper_bound(kept_, frame, before), std::move(frame));
    if (kept_.size() > most_) kept_.pop_back();
  }

  /// Gives each case of a kept name its pictures.
  void attachTo(std::vector<ReportCase>& cases) {
    for (ReportCase& one : cases) {
      const auto found = std::ranges::find(kept_, one.name, &Kept::name);
      if (found != kept_.end()) one.pictures.push_back(std::move(found->pictures));
    }
  }

private:
  struct Kept {
    std::string name;
    double severity = 0.0;
    bool first = false;
    ReportPictures pictures;
  };
  static bool before(const Kept& a, const Kept& b) {
    return a.first != b.first ? a.first : a.severity > b.severity;
  }

  std::size_t most_;
  std::vector<Kept> kept_; ///< the first one, then by severity
};

} // namespace offstage
