#include "src/scene/parse_body.h"
#include "src/scene/parse_look.h"

#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Calls `read` for a key's single value or for each one of its list; not at all when the key is absent.
void readEach(const TableReader& reader, std::string_view key, std::string_view wanted,
              const std::function<void(const TomlValue&, const std::string&)>& read) {
  const TomlValue* value = reader.find(key);
  if (value == nullptr) return;
  const std::string what = reader.described(key);
  const auto* list = value->array();
  if (list == nullptr) {
    read(*value, what);
  } else if (list->empty()) {
    reportMismatch(*value, what, wanted, reader.errors());
  } else {
    for (std::size_t i = 0; i < list->size(); ++i)
      read((*list)[i], fmt::format("value {} of {}", i + 1, what));
  }
}

std::vector<Launch::Moment> readMoments(const TableReader& reader) {
  std::vector<Launch::Moment> moments;
  if (!reader.has("at") && !reader.has("frame") && !reader.has("on")) {
    reader.errors().add(reader.value(), "[[launch]] needs 'at', 'frame' or 'on'");
  }
  reader.rejectBoth("frame", "at");
  reader.rejectBoth("on", "at");
  reader.rejectBoth("on", "frame");
  readEach(reader, "at", "a time or a list of times", [&](const TomlValue& value, const std::string& what) {
    const auto time = readNumber(value, what, Range::atLeast(0.0), reader.errors());
    if (time) moments.push_back({std::nullopt, *time});
  });
  readEach(reader, "frame", "a frame or a list of frames",
           [&](const TomlValue& value, const std::string& what) {
             const auto frame =
                 readInteger(value, what, 1, std::numeric_limits<std::int64_t>::max(), reader.errors());
             if (frame) moments.push_back({frame, 0.0});
           });
  return moments;
}

/// The first frame from 1 on whose time is not before `time` (s).
std::int64_t frameFrom(const Clock& clock, double time) {
  std::int64_t frame = clock.frameAt(time);
  if (clock.time(frame) < time) ++frame;
  while (frame > 1 && clock.time(frame - 1) >= time) --frame; // frames may have no length
  return std::max<std::int64_t>(frame, 1);
}

/// When the recorded user presses what 'on' names: "key SPACE", "button left".
void readPresses(SceneBuilder& builder, const TableReader& reader, std::vector<Launch::Moment>& moments) {
  constexpr std::string_view kKey = "key ";
  constexpr std::string_view kButton = "button ";
  const auto on = reader.givenString("on");
  if (!on) return;
  const bool key = on->starts_with(kKey) && on->size() > kKey.size();
  const bool button = *on == "button left" || *on == "button middle" || *on == "button right";
  if (!key && !button) {
    reader.reject("on", "must be \"key NAME\", or \"button left\", \"button middle\" or \"button right\"");
    return;
  }
  if (!builder.input) {
    reader.reject("on", "waits for recorded input, but the scene has no [input]");
    return;
  }
  const std::string name = on->substr(key ? kKey.size() : kButton.size());
  for (const double time : builder.input->presses(key ? InputAction::KeyDown : InputAction::ButtonDown, name))
    moments.push_back({std::nullopt, time});
  // The user saw frames. Where these do not last as long as the steps that they show, only their number
  // tells when.
  if (builder.scene.world.stepping.form != Stepping::Form::Fixed) return;
  for (Launch::Moment& moment : moments) moment.frame = frameFrom(builder.scene.clock, moment.time);
}

/// The anchor of a key, or where the pointer is at each of the moments.
Anchor readTarget(SceneBuilder& builder, const TableReader& reader, std::string_view key, Launch& launch,
                  std::optional<Vec2> Launch::Moment::*pointer) {
  if (!builder.isPointer(reader, key)) return builder.readAnchor(reader, key).value_or(Anchor{});
  const Clock& clock = builder.scene.clock;
  const bool pressed = reader.has("on");
  for (Launch::Moment& moment : launch.moments) {
    const double time =
        moment.frame && !pressed ? clock.time(std::min(*moment.frame, clock.steps())) : moment.time;
    if (builder.input) moment.*pointer = builder.input->mouseAt(time);
  }
  return {};
}

} // namespace

void parseLaunch(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"launch"}, "[[launch]]", builder.errors);
  Launch launch;
  launch.moments = readMoments(reader);
  readPresses(builder, reader, launch.moments);
  launch.from = readTarget(builder, reader, "from", launch, &Launch::Moment::from);
  launch.toward = readTarget(builder, reader, "toward", launch, &Launch::Moment::toward);
  launch.speed = builder.view.length()(reader.number("speed", Range::atLeast(0.0)));

  Body& body = launch.prototype;
  readCommonProperties(builder, reader, body);
  readSurface(reader, body);
  body.feelsGravity = false;
  body.integrator = builder.integrator;
  body.radius = builder.view.length()(reader.number("radius", Range::atLeast(0.0)));
  body.mass = reader.number("mass", Range::above(0.0));
  body.look = readLooks(builder, reader, body, false).front();
  builder.requireFinite(table, "[[launch]]",
                        {launch.speed, body.radius, launch.from.point.x(), launch.from.point.y(),
                         launch.toward.point.x(), launch.toward.point.y()});
  builder.scene.world.launches.push_back(std::move(launch));
  builder.launchTables.push_back(&table);
}

} // namespace offstage
