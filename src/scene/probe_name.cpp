#include "src/scene/probe_name.h"

#include "src/scene/nearest.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include <fmt/core.h>

namespace offstage {
namespace {

/// What a quantity counts; its unit and its place under a [view] follow from it.
enum class Dimension : std::uint8_t {
  PositionX,
  PositionY,
  Length,
  VelocityX,
  VelocityY,
  Speed,
  Energy,
  None
};

struct QuantityName {
  std::string_view name;
  Quantity quantity;
  Dimension dimension;
  bool ofAll; ///< may stand alone, for all bodies
};

constexpr QuantityName kQuantities[] = {
    {"x", Quantity::X, Dimension::PositionX, false},
    {"y", Quantity::Y, Dimension::PositionY, false},
    {"vx", Quantity::Vx, Dimension::VelocityX, false},
    {"vy", Quantity::Vy, Dimension::VelocityY, false},
    {"speed", Quantity::Speed, Dimension::Speed, false},
    {"px", Quantity::Px, Dimension::VelocityX, false},
    {"py", Quantity::Py, Dimension::VelocityY, false},
    {"momentum", Quantity::Momentum, Dimension::Speed, true},
    {"kinetic", Quantity::Kinetic, Dimension::Energy, true},
    {"potential", Quantity::Potential, Dimension::Energy, true},
    {"energy", Quantity::Energy, Dimension::Energy, true},
    {"count", Quantity::Count, Dimension::None, true},
};

/// Among more names than this nobody's typo is looked for, as SceneBuilder has it.
constexpr std::size_t kMostSuggested = 1000;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string suggestion(std::string_view typed, std::span<const std::string_view> known,
                       std::string_view before = "", std::string_view after = "") {
  const std::string_view near = nearest(typed, known);
  if (near.empty()) return "";
  return fmt::format("; did you mean {}?", quotedText(fmt::format("{}{}{}", before, near, after)));
}

std::optional<std::uint32_t> groupNamed(const SceneBuilder& builder, std::string_view name) {
  if (builder.scene.replay) {
    const auto& groups = builder.scene.replay->trace.groups;
    const auto found = std::find(groups.begin(), groups.end(), name);
    if (found == groups.end()) return std::nullopt;
    return static_cast<std::uint32_t>(found - groups.begin());
  }
  const auto found = builder.groups.find(name);
  if (found == builder.groups.end()) return std::nullopt;
  return found->second;
}

/// `#12`, the body with this id, or a body's name.
std::optional<std::uint32_t> bodyNamed(const SceneBuilder& builder, std::string_view name) {
  if (name.starts_with('#')) {
    std::uint32_t id = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + 1, end, id);
    if (error == std::errc() && rest == end) return id;
  }
  const auto found = builder.bodies.find(name);
  if (found == builder.bodies.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string_view> knownNames(const SceneBuilder& builder, bool withGroups) {
  std::vector<std::string_view> names;
  if (builder.bodies.size() > kMostSuggested || builder.groups.size() > kMostSuggested) return names;
  for (const auto& [name, id] : builder.bodies) names.emplace_back(name);
  if (!withGroups) return names;
  for (const auto& [name, index] : builder.groups) names.emplace_back(name);
  if (builder.scene.replay) {
    for (const std::string& name : builder.scene.replay->trace.groups) names.emplace_back(name);
  }
  return names;
}

std::uint32_t requireBody(const SceneBuilder& builder, std::string_view name) {
  if (const auto body = bodyNamed(builder, name)) return *body;
  if (groupNamed(builder, name))
    throw ProbeError(
        fmt::format("{} is a group, and an error is of one body against another", quotedText(name)));
  throw ProbeError(
      fmt::format("there is no body {}{}", quotedText(name), suggestion(name, knownNames(builder, false))));
}

void setDimension(const SceneBuilder& builder, Dimension dimension, NamedProbe& named) {
  const View& view = builder.view;
  const double scale = view.length().scale;
  const std::string_view length = scale == 1.0 ? "px" : "m";
  const bool ofMass = named.probe.quantity == Quantity::Px || named.probe.quantity == Quantity::Py ||
                      named.probe.quantity == Quantity::Momentum;
  const std::string_view mass = ofMass ? "mass·" : "";
  switch (dimension) {
  case Dimension::PositionX:
    named.probe.zero = view.x().offset;
    named.probe.unit = view.x().scale;
    named.unit = length;
    break;
  case Dimension::PositionY:
    named.probe.zero = view.y().offset;
    named.probe.unit = view.y().scale;
    named.unit = length;
    break;
  case Dimension::Length:
    named.probe.unit = scale;
    named.unit = length;
    break;
  case Dimension::VelocityX:
    named.probe.unit = view.vectorX().scale;
    named.unit = fmt::format("{}{}/s", mass, length);
    break;
  case Dimension::VelocityY:
    named.probe.unit = view.vectorY().scale;
    named.unit = fmt::format("{}{}/s", mass, length);
    break;
  case Dimension::Speed:
    named.probe.unit = scale;
    named.unit = fmt::format("{}{}/s", mass, length);
    break;
  case Dimension::Energy:
    named.probe.unit = scale * scale;
    named.unit = fmt::format("mass·{}²/s²", length);
    break;
  case Dimension::None:
    break;
  }
}

const QuantityName* quantityNamed(std::string_view name, bool ofAll) {
  for (const QuantityName& candidate : kQuantities) {
    if (candidate.name == name && (candidate.ofAll || !ofAll)) return &candidate;
  }
  return nullptr;
}

void setQuantity(const SceneBuilder& builder, const QuantityName& quantity, NamedProbe& named) {
  const bool needsForces = quantity.quantity == Quantity::Potential || quantity.quantity == Quantity::Energy;
  if (builder.scene.replay && needsForces)
    throw ProbeError("a replayed trace has no forces, so its potential energy is unknown");
  named.probe.quantity = quantity.quantity;
  setDimension(builder, quantity.dimension, named);
}

/// A name without a dot.
void findAlone(const SceneBuilder& builder, std::string_view name, NamedProbe& named) {
  if (name == "t") {
    named.unit = "s";
    return;
  }
  if (name == "frame") {
    named.probe.quantity = Quantity::Frame;
    return;
  }
  if (const QuantityName* quantity = quantityNamed(name, true)) {
    setQuantity(builder, *quantity, named);
    return;
  }
  if (bodyNamed(builder, name) || groupNamed(builder, name))
    throw ProbeError(fmt::format("{} lacks a quantity, such as {}", quotedText(name),
                                 quotedText(fmt::format("{}.speed", name))));
  if (quantityNamed(name, false) != nullptr)
    throw ProbeError(
        fmt::format("{} needs a body or a group before it, such as \"ball.{}\"", quotedText(name), name));
  std::vector<std::string_view> known{"t", "frame"};
  for (const QuantityName& quantity : kQuantities) {
    if (quantity.ofAll) known.push_back(quantity.name);
  }
  const std::string hint = suggestion(name, known);
  throw ProbeError(fmt::format(
      "{} is not known{}", quotedText(name),
      hint.empty() ? "; allowed are t, frame, momentum, kinetic, potential, energy, count and NAME.QUANTITY"
                   : hint));
}

/// `OTHER` of "error(OTHER)"; nothing when it is another quantity.
std::optional<std::string_view> errorArgument(std::string_view quantity) {
  constexpr std::string_view kError = "error";
  if (!quantity.starts_with(kError)) return std::nullopt;
  quantity = trimmed(quantity.substr(kError.size()));
  if (!quantity.starts_with('(') || !quantity.ends_with(')'))
    throw ProbeError("an error is written as \"NAME.error(OTHER)\", with the body that it is held against");
  return trimmed(quantity.substr(1, quantity.size() - 2));
}

/// Where the dot stands that parts a name from its quantity: the last one outside parentheses.
std::size_t quantityDot(std::string_view name) {
  return name.substr(0, name.find('(')).rfind('.');
}

} // namespace

NamedProbe findProbe(const SceneBuilder& builder, std::string_view name) {
  name = trimmed(name);
  NamedProbe named;
  named.name = name;
  if (name.empty()) throw ProbeError("it is empty");
  const std::size_t dot = quantityDot(name);
  if (dot == std::string_view::npos) {
    findAlone(builder, name, named);
    return named;
  }
  const std::string_view of = trimmed(name.substr(0, dot));
  const std::string_view quantity = trimmed(name.substr(dot + 1));
  const std::string after = fmt::format(".{}", quantity);
  if (const auto other = errorArgument(quantity)) {
    named.probe.body = requireBody(builder, of);
    named.probe.other = requireBody(builder, *other);
    named.probe.quantity = Quantity::Error;
    setDimension(builder, Dimension::Length, named);
    return named;
  }
  named.probe.body = bodyNamed(builder, of);
  const auto group = groupNamed(builder, of);
  if (named.probe.body && group)
    throw ProbeError(fmt::format("{} is both a body and a group; the body alone is \"#{}\"", quotedText(of),
                                 *named.probe.body));
  if (!named.probe.body && !group)
    throw ProbeError(fmt::format("there is no body and no group {}{}", quotedText(of),
                                 suggestion(of, knownNames(builder, true), "", after)));
  if (group) named.probe.group = group;
  if (const QuantityName* known = quantityNamed(quantity, false)) {
    setQuantity(builder, *known, named);
    return named;
  }
  std::vector<std::string_view> quantities;
  std::string allowed;
  for (const QuantityName& candidate : kQuantities) {
    quantities.push_back(candidate.name);
    allowed += fmt::format("{}, ", candidate.name);
  }
  const std::string hint = suggestion(quantity, quantities, fmt::format("{}.", of));
  throw ProbeError(fmt::format("{} is no quantity of a body{}", quotedText(quantity),
                               hint.empty() ? fmt::format("; allowed are {}error(OTHER)", allowed) : hint));
}

std::optional<NamedProbe> readProbe(SceneBuilder& builder, const TomlValue& value, const std::string& what) {
  const auto* name = std::get_if<std::string>(&value.data);
  if (name == nullptr) {
    reportMismatch(value, what, "the name of a value, such as \"ball.speed\"", builder.errors);
    return std::nullopt;
  }
  try {
    return findProbe(builder, *name);
  } catch (const ProbeError& error) {
    builder.errors.add(value, fmt::format("{} is no value of the scene: {}", what, error.what()));
    return std::nullopt;
  }
}

} // namespace offstage
