#include "tests/support/still_scene.h"

#include "tests/support/still_json.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace offstage::test {
namespace {

const std::filesystem::path kFolder = OFFSTAGE_SOURCE_DIR "/tests/reference/stills";

Color readColor(const JsonValue& json) {
  const auto component = [&](std::size_t i) {
    return static_cast<std::uint8_t>(json["rgb"].array().at(i).number());
  };
  return Color::rgb(component(0), component(1), component(2), json["alpha"].number());
}

Paint readPaint(const JsonValue& json) {
  if (json["type"].text() == "color") return readColor(json);
  ImagePattern pattern;
  pattern.file = kFolder / json["image"].text();
  pattern.anchor = {json["x"].number(), json["y"].number(), json["width"].number(), json["height"].number()};
  pattern.proportional = json["proportional"].boolean();
  return pattern;
}

Stroke readStroke(const JsonValue& json) {
  Stroke stroke;
  stroke.paint = readPaint(json["paint"]);
  stroke.width = json["width"].number();
  const std::string& position = json["position"].text();
  if (position == "INSIDE") {
    stroke.align = StrokeAlign::Inside;
  } else if (position == "OUTSIDE") {
    stroke.align = StrokeAlign::Outside;
  } else if (position != "CENTERED") {
    throw std::runtime_error("a still's stroke has the position " + position);
  }
  return stroke;
}

StillShape readShape(const JsonValue& json) {
  StillShape shape;
  shape.circle = json["type"].text() == "circle";
  if (shape.circle) {
    shape.position = Vec2(json["cx"].number(), json["cy"].number());
    shape.radius = json["r"].number();
  } else {
    shape.position = Vec2(json["x"].number(), json["y"].number());
    shape.size = Vec2(json["w"].number(), json["h"].number());
  }
  shape.look.fill.reset();
  if (!json["fill"].isNull()) shape.look.fill = readPaint(json["fill"]);
  if (!json["stroke"].isNull()) shape.look.stroke = readStroke(json["stroke"]);
  if (!json["opacity"].isNull()) shape.look.opacity = json["opacity"].number();
  return shape;
}

} // namespace

Still loadStill(const std::string& name) {
  const std::ifstream file(kFolder / (name + ".json"));
  if (!file) throw std::runtime_error("no still " + name);
  std::ostringstream text;
  text << file.rdbuf();
  const JsonValue json = JsonValue::parse(text.str());
  Still still;
  still.name = name;
  still.width = static_cast<int>(json["width"].number());
  still.height = static_cast<int>(json["height"].number());
  still.background = readColor(json["background"]);
  for (const JsonValue& shape : json["shapes"].array()) still.shapes.push_back(readShape(shape));
  still.expected = loadImage(kFolder / (name + ".png"));
  return still;
}

} // namespace offstage::test
