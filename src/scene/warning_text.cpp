#include "src/scene/warning_text.h"

#include "src/scene/limits.h"
#include "src/scene/quote.h"
#include "src/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr double kMostSubsteps = 10000.0; ///< that [clock] takes

std::string_view wordOf(Integrator method) {
  switch (method) {
  case Integrator::ExplicitEuler:
    return "explicit-euler";
  case Integrator::SemiImplicitEuler:
    return "semi-implicit-euler";
  case Integrator::Verlet:
    return "verlet";
  case Integrator::Midpoint:
    return "midpoint";
  case Integrator::Rk4:
    return "rk4";
  case Integrator::Exact:
    break;
  }
  return "exact";
}

std::string_view wordOf(Side side) {
  switch (side) {
  case Side::Left:
    return "left";
  case Side::Right:
    return "right";
  case Side::Top:
    return "upper";
  case Side::Bottom:
    break;
  }
  return "lower";
}

/// "[clock] substeps = 3" where steps have to be `shorter` times as short as now.
std::string substepsFor(double shorter, int now) {
  const double wanted = std::floor(shorter * now) + 1.0;
  return wanted <= kMostSubsteps ? fmt::format("[clock] substeps = {}", static_cast<int>(wanted))
                                 : "shorter steps ([clock])";
}

std::string pointText(const Vec2& point) {
  return fmt::format("({}, {})", numberText(point.x()), numberText(point.y()));
}

std::string textOf(const NotFinite& lost) {
  const bool placed = lost.position.allFinite();
  return fmt::format("its {} is {}: from here on it is nowhere; look for a division by 0, or take "
                     "shorter steps ([clock] substeps)",
                     placed ? "velocity" : "position", pointText(placed ? lost.velocity : lost.position));
}

std::string textOf(const EnergyGrowth& growth, bool solver) {
  std::string text = fmt::format(
      "the bodies have gained {:.3g} times the energy that they should have, {:.3g} mass·px²/s² from nowhere",
      growth.gained / growth.usual, growth.gained);
  if (growth.walls) text += "; a multiplier above 1 in [walls] makes energy, one of at most 1 does not";
  if (growth.euler)
    text +=
        "; \"explicit-euler\" gains energy, \"semi-implicit-euler\", \"verlet\" and \"rk4\" keep it better";
  if (growth.attract) text += "; near a point that attracts, a softening helps";
  text += "; shorter steps ([clock] substeps) help";
  if (solver)
    text += ", but not where bodies overlap when they come: the contact solver throws those apart, so let "
            "them begin apart";
  return text;
}

std::string textOf(const LongStep& found, int substeps) {
  const bool grows =
      found.integrator == Integrator::ExplicitEuler || found.integrator == Integrator::Midpoint;
  const std::string way = substepsFor(found.step / found.limit, substeps);
  if (grows)
    return fmt::format(
        "steps of {:.4g} s are too long for its spring: by \"{}\" a motion at {:.4g} rad/s more "
        "than doubles in each swing, where steps of at most {:.4g} s let it grow less; {} does "
        "that, and \"semi-implicit-euler\", \"verlet\" or \"rk4\" do not let it grow",
        found.step, wordOf(found.integrator), found.frequency, found.limit, way);
  return fmt::format("steps of {:.4g} s are too long for its spring: at {:.4g} rad/s \"{}\" is stable up to "
                     "{:.4g} s; {} is enough, or make the spring softer or the body heavier",
                     found.step, found.frequency, wordOf(found.integrator), found.limit, way);
}

} // namespace

std::span<const std::string_view> warningWords() {
  static constexpr std::array<std::string_view, kWarningKinds> kWords{"lost", "energy", "crossing", "step"};
  return kWords;
}

WarningText::WarningText(const Scene& scene, std::string panel)
    : file_(printable(scene.file.string())),
      panel_(std::move(panel)),
      names_(scene.bodyNames),
      groups_(scene.world.groups),
      expected_(scene.expectedWarnings),
      substeps_(scene.world.substeps),
      form_(scene.world.stepping.form),
      solver_(scene.world.contactModel == ContactModel::Solver),
      clamps_(scene.world.walls.clamp) {}

std::string WarningText::bodyName(std::uint32_t id) const {
  const std::string name = id < names_.size() ? names_[id] : "";
  return fmt::format("body {}{}", id, name.empty() ? "" : ' ' + quotedText(name));
}

std::string WarningText::textOfCrossing(const Crossing& crossing) const {
  if (crossing.side) return textOfEdge(*crossing.side);
  std::string text =
      fmt::format("it went through {} in one step without touching it: {:.4g} px, where both together are "
                  "{:.4g} px wide; ",
                  bodyName(*crossing.other), crossing.way, crossing.width);
  if (solver_) text += "the contact solver looks for contacts once a step, whatever its substeps: ";
  text += "continuous = true on one of them makes its whole way count";
  const std::string steps = stepsFor(crossing);
  return steps.empty() ? text : text + fmt::format(", or {} shortens the steps", steps);
}

std::string WarningText::textOfEdge(Side side) const {
  const std::string text = fmt::format("it went through the pane's {} edge and is behind it; ", wordOf(side));
  if (solver_)
    return text + "a \"slide\" pushes it after the walls have held it: response = \"bounce\" does not";
  return text + (clamps_ ? "other bodies push it: [world] contacts = \"solver\" does not let them"
                         : "[walls] clamp = true puts it back onto the edge");
}

/// The key that makes a move at most half as long as both bodies are wide; empty: none does.
std::string WarningText::stepsFor(const Crossing& crossing) const {
  if (!(crossing.width > 0.0)) return "";
  const double shorter = 2.0 * crossing.way / crossing.width;
  if (!solver_) return substepsFor(shorter, substeps_);
  const double dt = crossing.step / (std::floor(shorter) + 1.0);
  if (!(dt >= kMinStep)) return "";
  const bool divides = form_ == Stepping::Form::Clamped || form_ == Stepping::Form::Accumulator;
  return fmt::format("[clock] {}dt = {:.3g}", divides ? "" : "step = \"clamped\" with ", dt);
}

std::string WarningText::of(const Warning& warning) const {
  std::string text = panel_.empty() ? "" : fmt::format("panel {}, ", quotedText(panel_));
  text += fmt::format("frame {} ({:.6g} s), {}", warning.frame, warning.time, bodyName(warning.body));
  const bool unnamed = warning.body >= names_.size() || names_[warning.body].empty();
  if (unnamed && warning.group < groups_.size())
    text += fmt::format(" of {}", quotedText(groups_[warning.group]));
  text += ": ";
  struct Visitor {
    const WarningText& self;
    std::string operator()(const NotFinite& what) const { return textOf(what); }
    std::string operator()(const EnergyGrowth& what) const { return textOf(what, self.solver_); }
    std::string operator()(const Crossing& what) const { return self.textOfCrossing(what); }
    std::string operator()(const LongStep& what) const { return textOf(what, self.substeps_); }
  };
  text += std::visit(Visitor{*this}, warning.what);
  return text + fmt::format(" [{}]", warningWords()[warning.what.index()]);
}

bool WarningText::isExpected(const Warning& warning) const {
  return std::find(expected_.begin(), expected_.end(), warning.what.index()) != expected_.end();
}

} // namespace offstage
