#include "src/scene/parse_overlay.h"

#include "src/scene/overlay.h"
#include "src/scene/palette.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr double kMostPixels = 16384.0;
/// More lines than this are grey paint.
constexpr double kMostLines = 2000.0;

constexpr Choice<OverlayLayer> kLayers[] = {{"behind", OverlayLayer::Behind}, {"front", OverlayLayer::Front}};
constexpr Choice<ArrowQuantity> kQuantities[] = {{"velocity", ArrowQuantity::Velocity},
                                                 {"acceleration", ArrowQuantity::Acceleration},
                                                 {"force", ArrowQuantity::Force}};
constexpr Choice<MarkOverlay::Shape> kMarks[] = {{"cross", MarkOverlay::Shape::Cross},
                                                 {"plus", MarkOverlay::Shape::Plus},
                                                 {"dot", MarkOverlay::Shape::Dot}};

const Range kPixels = Range::aboveUpTo(0.0, kMostPixels);

std::optional<Color> givenColor(const TableReader& reader, std::string_view key) {
  if (!reader.has(key)) return std::nullopt;
  return reader.color(key);
}

/// One name of `of`: a body's, or else a group's.
void addSelected(SceneBuilder& builder, const TomlValue& value, const std::string& what,
                 BodySelection& selection) {
  const auto* name = std::get_if<std::string>(&value.data);
  if (name == nullptr) {
    reportMismatch(value, what, "the name of a body or a group", builder.errors);
    return;
  }
  if (const auto body = builder.bodies.find(*name); body != builder.bodies.end()) {
    selection.bodies.push_back(body->second);
    return;
  }
  const Scene& scene = builder.scene;
  const std::vector<std::string>& groups = scene.replay ? scene.replay->trace.groups : scene.world.groups;
  if (const auto group = std::ranges::find(groups, *name); group != groups.end()) {
    selection.groups.push_back(static_cast<std::uint32_t>(group - groups.begin()));
    return;
  }
  builder.errors.add(
      value, fmt::format("{} names {}, which is neither a body nor a group", what, quotedText(*name)));
}

BodySelection readSelection(SceneBuilder& builder, const TableReader& reader) {
  BodySelection selection;
  const TomlValue* of = reader.find("of");
  if (of == nullptr) return selection;
  selection.all = false;
  const std::string what = reader.described("of");
  if (of->array() == nullptr) {
    addSelected(builder, *of, what, selection);
  } else if (of->array()->empty()) {
    reportMismatch(*of, what, "the name of a body or a group, or a list of them", builder.errors);
  } else {
    for (std::size_t i = 0; i < of->array()->size(); ++i)
      addSelected(builder, (*of->array())[i], fmt::format("value {} of {}", i + 1, what), selection);
  }
  return selection;
}

Color inkOf(const SceneBuilder& builder, double opacity) {
  return inkOf(builder.scene.theme, builder.scene.background, opacity);
}

void readTrail(SceneBuilder& builder, const TableReader& reader) {
  TrailOverlay trail;
  trail.of = readSelection(builder, reader);
  trail.length = reader.number("length", Range::above(0.0));
  trail.width = reader.number("width", kPixels);
  trail.color = givenColor(reader, "color");
  trail.opacity = reader.number("opacity", Range::between(0.0, 1.0));
  trail.fade = reader.boolean("fade");
  trail.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.trails.push_back(trail);
}

void readGhost(SceneBuilder& builder, const TableReader& reader) {
  GhostOverlay ghost;
  ghost.of = readSelection(builder, reader);
  ghost.every = reader.number("every", Range::above(0.0));
  ghost.length = reader.givenNumber("length", Range::above(0.0)).value_or(kForever);
  ghost.opacity = reader.number("opacity", Range::between(0.0, 1.0));
  ghost.fade = reader.boolean("fade");
  ghost.layer = reader.choice("layer", kLayers);
  if (ghost.fade && !reader.has("length")) reader.reject("fade", "needs a 'length' over which to fade");
  builder.scene.overlays.ghosts.push_back(ghost);
}

void readArrow(SceneBuilder& builder, const TableReader& reader) {
  ArrowOverlay arrow;
  arrow.of = readSelection(builder, reader);
  arrow.quantity = reader.choice("quantity", kQuantities);
  const Scene& scene = builder.scene;
  if (scene.replay && arrow.quantity != ArrowQuantity::Velocity)
    reader.reject("quantity", "can only be \"velocity\" beside [replay], which knows no forces");
  if (scene.replay && arrow.quantity == ArrowQuantity::Velocity && !scene.replay->trace.hasVelocity)
    builder.errors.add(reader.value(), "[[arrow]] needs velocities, but the trace of [replay] has none");
  const double byDefault = arrow.quantity == ArrowQuantity::Velocity ? 0.2 : 0.1;
  arrow.scale = reader.givenNumber("scale", Range::above(0.0)).value_or(byDefault);
  arrow.width = reader.number("width", kPixels);
  arrow.color = givenColor(reader, "color");
  arrow.opacity = reader.number("opacity", Range::between(0.0, 1.0));
  arrow.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.arrows.push_back(arrow);
}

void readMark(SceneBuilder& builder, const TableReader& reader) {
  MarkOverlay mark;
  mark.of = readSelection(builder, reader);
  mark.shape = reader.choice("shape", kMarks);
  mark.size = reader.number("size", kPixels);
  mark.width = reader.number("width", kPixels);
  mark.color = givenColor(reader, "color").value_or(inkOf(builder, 1.0));
  mark.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.marks.push_back(mark);
}

void readOutline(SceneBuilder& builder, const TableReader& reader) {
  OutlineOverlay outline;
  outline.of = readSelection(builder, reader);
  outline.margin = reader.number("margin", Range::between(-kMostPixels, kMostPixels));
  outline.width = reader.number("width", kPixels);
  outline.color = givenColor(reader, "color").value_or(inkOf(builder, 0.6));
  outline.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.outlines.push_back(outline);
}

void readContactMark(SceneBuilder& builder, const TableReader& reader) {
  ContactMarkOverlay mark;
  if (builder.scene.replay)
    builder.errors.add(reader.value(),
                       "[[contact_mark]] cannot stand beside [replay], where nothing collides");
  mark.of = readSelection(builder, reader);
  mark.duration = reader.number("duration", Range::above(0.0));
  mark.length = reader.number("length", kPixels);
  mark.width = reader.number("width", kPixels);
  mark.normal = givenColor(reader, "normal").value_or(palette::kVermilion);
  mark.tangent = givenColor(reader, "tangent").value_or(palette::kGreen);
  mark.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.contactMarks.push_back(mark);
}

/// A step between lines in the scene's units, as px. Without one: the round number of units that divides
/// `extent` px into about `parts`.
double readStep(const SceneBuilder& builder, const TableReader& reader, double extent, double parts) {
  const double unit = builder.scene.overlays.units.pixels;
  const auto given = reader.givenNumber("step", Range::above(0.0));
  if (!given) return roundStep(std::max(extent / (parts * unit), 1e-9)) * unit;
  const double step = *given * unit;
  if (step >= extent / kMostLines) return step;
  reader.reject("step", fmt::format("gives more than {} lines", kMostLines));
  return extent;
}

void readGrid(SceneBuilder& builder, const TableReader& reader) {
  GridOverlay grid;
  const Scene& scene = builder.scene;
  grid.step = readStep(builder, reader, std::max(scene.size[0], scene.size[1]), 12.0);
  grid.width = reader.number("width", kPixels);
  grid.color = givenColor(reader, "color").value_or(gridColorOf(scene.theme, scene.background));
  grid.axes = reader.boolean("axes");
  grid.axisColor = givenColor(reader, "axis_color").value_or(inkOf(builder, 0.45));
  grid.labels = reader.boolean("labels");
  grid.labelSize = reader.number("label_size", kPixels);
  grid.layer = reader.choice("layer", kLayers);
  builder.scene.overlays.grids.push_back(grid);
}

void readRuler(SceneBuilder& builder, const TableReader& reader) {
  RulerOverlay ruler;
  const auto from = builder.readAnchor(reader, "from");
  const auto to = builder.readAnchor(reader, "to");
  double extent = std::max(builder.scene.size[0], builder.scene.size[1]);
  if (from && to && !from->body && !to->body) extent = length(to->point - from->point);
  ruler.step = readStep(builder, reader, std::max(extent, 1.0), 10.0);
  ruler.width = reader.number("width", kPixels);
  ruler.color = givenColor(reader, "color").value_or(inkOf(builder, 0.8));
  ruler.unit = reader.givenString("unit").value_or("");
  ruler.labelSize = reader.number("label_size", kPixels);
  ruler.layer = reader.choice("layer", kLayers);
  ruler.where = locationOf(builder.scene, reader.value());
  if (!from || !to) return;
  ruler.from = *from;
  ruler.to = *to;
  builder.scene.overlays.rulers.push_back(ruler);
}

using Read = void (*)(SceneBuilder&, const TableReader&);

void readEach(SceneBuilder& builder, const TableReader& top, std::string_view key, Read read) {
  const TomlValue* value = top.find(key);
  if (value == nullptr) return;
  const std::string label = fmt::format("[[{}]]", key);
  if (value->array() == nullptr || value->array()->empty()) {
    reportMismatch(*value, top.described(key), fmt::format("an array of tables, {}", label), builder.errors);
    return;
  }
  for (const TomlValue& element : *value->array()) {
    if (element.table() == nullptr) {
      reportMismatch(element, "every value of " + top.described(key), "a table", builder.errors);
    } else {
      read(builder, TableReader(element, {key}, label, builder.errors));
    }
  }
}

} // namespace

void parseOverlays(SceneBuilder& builder, const TableReader& top) {
  const View& view = builder.view;
  OverlayUnits& units = builder.scene.overlays.units;
  units.pixels = view.length()(1.0);
  units.origin = view.position(Vec2::Zero());
  units.yUp = view.vectorY()(1.0) < 0.0;

  if (const TomlValue* grid = top.find("grid")) {
    if (grid->table() == nullptr) {
      reportMismatch(*grid, top.described("grid"), "one table, [grid]", builder.errors);
    } else {
      readGrid(builder, TableReader(*grid, {"grid"}, "[grid]", builder.errors));
    }
  }
  readEach(builder, top, "trail", readTrail);
  readEach(builder, top, "ghost", readGhost);
  readEach(builder, top, "outline", readOutline);
  readEach(builder, top, "mark", readMark);
  readEach(builder, top, "arrow", readArrow);
  readEach(builder, top, "contact_mark", readContactMark);
  readEach(builder, top, "ruler", readRuler);
}

} // namespace offstage
