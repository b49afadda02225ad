#include "src/scene/scene_keys.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace offstage {
namespace {

// clang-format off
constexpr SceneKey kKeys[] = {
    // table, key, type, unit, default
    {"", "title", "string", "", "the file's name without its ending"},
    {"", "duration", "number", "s", "10"},
    {"", "seed", "integer", "", "0"},
    {"", "theme", "table", "", "none"},
    {"", "frame", "table", "", "none"},
    {"", "clock", "table", "", "none"},
    {"", "world", "table", "", "none"},
    {"", "walls", "table", "", "none"},
    {"", "view", "table", "", "none"},
    {"", "input", "table", "", "none"},
    {"", "body", "tables", "", "none"},
    {"", "bodies", "tables", "", "none"},
    {"", "spawn", "tables", "", "none"},
    {"", "launch", "tables", "", "none"},
    {"", "collide", "tables", "", "none"},
    {"", "force", "tables", "", "none"},
    {"", "text", "tables", "", "none"},
    {"", "trail", "tables", "", "none"},
    {"", "ghost", "tables", "", "none"},
    {"", "outline", "tables", "", "none"},
    {"", "mark", "tables", "", "none"},
    {"", "arrow", "tables", "", "none"},
    {"", "contact_mark", "tables", "", "none"},
    {"", "grid", "table", "", "none"},
    {"", "ruler", "tables", "", "none"},
    {"", "plot", "tables", "", "none"},
    {"", "panel", "tables", "", "none"},
    {"", "panels", "table", "", "none"},
    {"", "replay", "table", "", "none"},
    {"", "golden", "table", "", "none"},
    {"", "timeline", "table", "", "none"},
    {"", "section", "tables", "", "none"},
    {"", "caption", "tables", "", "none"},
    {"", "pause", "tables", "", "none"},
    {"", "speed", "tables", "", "none"},
    {"", "camera", "tables", "", "none"},
    {"", "narration", "table", "", "none"},
    {"", "sound", "table", "", "none"},
    {"", "poster", "table", "", "none"},

    {"theme", "name", "choice", "", "\"light\""},
    {"theme", "background", "colour", "", "the theme's"},
    {"theme", "text", "colour", "", "the theme's"},
    {"theme", "muted", "colour", "", "the theme's"},
    {"theme", "grid", "colour", "", "the theme's"},
    {"theme", "palette", "list of colours", "", "the theme's"},

    {"frame", "size", "[width, height]", "px", "[640, 480]"},
    {"frame", "background", "colour", "", "\"white\""},
    {"frame", "scale", "number", "", "1"},

    {"clock", "fps", "number", "1/s", "60"},
    {"clock", "recorded", "file", "", "none"},
    {"clock", "step", "choice", "", "\"variable\""},
    {"clock", "dt", "number", "s", "the 60th part of one"},
    {"clock", "substeps", "integer", "", "1"},

    {"world", "gravity", "[x, y]", "px/s²", "[0, 9.8]"},
    {"world", "integrator", "choice", "", "\"semi-implicit-euler\""},
    {"world", "contacts", "choice", "", "\"lecture\""},
    {"world", "iterations", "integer", "", "1"},
    {"world", "expect", "list of words", "", "none"},

    {"walls", "left", "number", "", "open"},
    {"walls", "right", "number", "", "open"},
    {"walls", "top", "number", "", "open"},
    {"walls", "bottom", "number", "", "open"},
    {"walls", "all", "number", "", "open"},
    {"walls", "clamp", "boolean", "", "true"},

    {"view", "pixels_per_metre", "number", "px", "1"},
    {"view", "origin", "[x, y]", "px", "[0, 0]"},
    {"view", "y_up", "boolean", "", "false"},

    {"input", "log", "file", "", "required"},

    {"body", "name", "string", "", "none"},
    {"body", "group", "string", "", "\"bodies\""},
    {"body", "shape", "choice", "", "\"circle\""},
    {"body", "center", "[x, y]", "px", "required"},
    {"body", "radius", "number", "px", "required"},
    {"body", "position", "[x, y]", "px", "required"},
    {"body", "size", "[width, height]", "px", "required"},
    {"body", "velocity", "[x, y]", "px/s", "[0, 0]"},
    {"body", "acceleration", "[x, y]", "px/s²", "[0, 0]"},
    {"body", "gravity", "boolean", "", "true"},
    {"body", "mass", "number", "", "1"},
    {"body", "restitution", "number", "", "1"},
    {"body", "friction", "number", "", "0"},
    {"body", "integrator", "choice", "", "the world's"},
    {"body", "fixed", "boolean", "", "false"},
    {"body", "continuous", "boolean", "", "false"},
    {"body", "fill", "paint", "", "\"black\""},
    {"body", "stroke", "table", "", "none"},
    {"body", "opacity", "number", "", "1"},
    {"body", "leaving", "choice", "", "\"keep\""},

    {"bodies", "table", "file", "", "required"},

    {"fill", "image", "file", "", "required"},
    {"fill", "anchor", "[x, y, width, height]", "", "[0, 0, 1, 1]"},
    {"fill", "proportional", "boolean", "", "true"},
    {"fill", "cycle", "list of colours", "", "none"},

    {"stroke", "color", "colour", "", "\"black\""},
    {"stroke", "image", "file", "", "none"},
    {"stroke", "anchor", "[x, y, width, height]", "", "[0, 0, 1, 1]"},
    {"stroke", "proportional", "boolean", "", "true"},
    {"stroke", "width", "number", "px", "1"},
    {"stroke", "align", "choice", "", "\"centered\""},

    {"spawn", "every", "number", "s", "1"},
    {"spawn", "count", "choice", "", "\"spawned\""},
    {"spawn", "when", "choice", "", "\"before-update\""},
    {"spawn", "limit", "integer", "", "none"},
    {"spawn", "group", "string", "", "\"bodies\""},
    {"spawn", "shape", "choice", "", "\"circle\""},
    {"spawn", "center", "[x, y]", "px", "required"},
    {"spawn", "position", "[x, y]", "px", "required"},
    {"spawn", "x", "random number", "px", "required"},
    {"spawn", "y", "random number", "px", "required"},
    {"spawn", "radius", "random number", "px", "required"},
    {"spawn", "size", "[width, height]", "px", "required"},
    {"spawn", "width", "random number", "px", "required"},
    {"spawn", "height", "random number", "px", "required"},
    {"spawn", "velocity", "[x, y]", "px/s", "[0, 0]"},
    {"spawn", "vx", "random number", "px/s", "0"},
    {"spawn", "vy", "random number", "px/s", "0"},
    {"spawn", "acceleration", "[x, y]", "px/s²", "[0, 0]"},
    {"spawn", "ax", "random number", "px/s²", "0"},
    {"spawn", "ay", "random number", "px/s²", "0"},
    {"spawn", "gravity", "boolean", "", "true"},
    {"spawn", "mass", "random number", "", "1"},
    {"spawn", "restitution", "random number", "", "1"},
    {"spawn", "friction", "random number", "", "0"},
    {"spawn", "integrator", "choice", "", "the world's"},
    {"spawn", "fixed", "boolean", "", "false"},
    {"spawn", "continuous", "boolean", "", "false"},
    {"spawn", "fill", "paint", "", "\"black\""},
    {"spawn", "stroke", "table", "", "none"},
    {"spawn", "opacity", "number", "", "1"},
    {"spawn", "leaving", "choice", "", "\"keep\""},

    {"random", "int", "integer", "", "none"},
    {"random", "spread", "number", "the key's", "none"},
    {"random", "uniform", "[low, high]", "the key's", "none"},
    {"random", "gaussian", "[mean, deviation]", "the key's", "none"},

    {"launch", "at", "number or list", "s", "required"},
    {"launch", "frame", "integer or list", "", "required"},
    {"launch", "on", "key or button", "", "required"},
    {"launch", "from", "[x, y] or name", "px", "required"},
    {"launch", "toward", "[x, y] or name", "px", "required"},
    {"launch", "speed", "number", "px/s", "required"},
    {"launch", "radius", "number", "px", "required"},
    {"launch", "group", "string", "", "\"shots\""},
    {"launch", "mass", "number", "", "1"},
    {"launch", "continuous", "boolean", "", "false"},
    {"launch", "restitution", "number", "", "1"},
    {"launch", "friction", "number", "", "0"},
    {"launch", "fill", "paint", "", "\"black\""},
    {"launch", "stroke", "table", "", "none"},
    {"launch", "opacity", "number", "", "1"},
    {"launch", "leaving", "choice", "", "\"remove\""},

    {"collide", "between", "[group, group]", "", "required"},
    {"collide", "except", "list of groups", "", "none"},
    {"collide", "response", "choice", "", "\"bounce\""},
    {"collide", "restitution", "number", "", "1"},
    {"collide", "separate", "boolean", "", "true"},
    {"collide", "approaching_only", "boolean", "", "true"},

    {"force", "type", "choice", "", "required"},
    {"force", "group", "string", "", "none"},
    {"force", "body", "string", "", "none"},

    {"force.drag", "linear", "number", "mass/s", "0"},
    {"force.drag", "quadratic", "number", "mass/px", "0"},

    {"force.spring", "to", "[x, y] or name", "px", "required"},
    {"force.spring", "stiffness", "number", "mass/s²", "required"},
    {"force.spring", "length", "number", "px", "0"},
    {"force.spring", "damping", "number", "mass/s", "0"},

    {"force.attract", "to", "[x, y] or name", "px", "required"},
    {"force.attract", "strength", "number", "px³/s²", "required"},
    {"force.attract", "softening", "number", "px", "0"},

    {"force.wind", "velocity", "[x, y]", "px/s", "required"},
    {"force.wind", "coefficient", "number", "mass/s", "required"},

    {"force.expression", "fx", "expression", "mass·px/s²", "\"0\""},
    {"force.expression", "fy", "expression", "mass·px/s²", "\"0\""},

    {"text", "text", "string", "", "required"},
    {"text", "formula", "string", "", "required"},
    {"text", "at", "[x, y] or name", "px", "required"},
    {"text", "place", "choice", "", "required"},
    {"text", "offset", "[x, y]", "px", "[0, 0]"},
    {"text", "anchor", "choice", "", "the place, or the centre"},
    {"text", "align", "choice", "", "the anchor's side"},
    {"text", "size", "number", "px", "the pane's height/20"},
    {"text", "font", "choice or file", "", "\"sans\""},
    {"text", "color", "colour", "", "the theme's"},
    {"text", "opacity", "number", "", "1"},
    {"text", "line_height", "number", "em", "1.25"},
    {"text", "background", "colour", "", "none"},
    {"text", "padding", "number", "em", "0.3"},
    {"text", "outline", "colour", "", "none"},
    {"text", "outline_width", "number", "em", "0.1"},
    {"text", "upwards", "boolean", "", "false"},
    {"text", "from", "number", "s", "0"},
    {"text", "to", "number", "s", "none"},
    {"text", "fade", "number", "s", "0"},

    {"trail", "of", "name or list", "", "all bodies"},
    {"trail", "length", "number", "s", "2"},
    {"trail", "width", "number", "px", "3"},
    {"trail", "color", "colour", "", "the body's"},
    {"trail", "opacity", "number", "", "0.7"},
    {"trail", "fade", "boolean", "", "true"},
    {"trail", "layer", "choice", "", "\"behind\""},

    {"ghost", "of", "name or list", "", "all bodies"},
    {"ghost", "every", "number", "s", "0.25"},
    {"ghost", "length", "number", "s", "none"},
    {"ghost", "opacity", "number", "", "0.25"},
    {"ghost", "fade", "boolean", "", "false"},
    {"ghost", "layer", "choice", "", "\"behind\""},

    {"outline", "of", "name or list", "", "all bodies"},
    {"outline", "margin", "number", "px", "3"},
    {"outline", "width", "number", "px", "1.5"},
    {"outline", "color", "colour", "", "ink"},
    {"outline", "layer", "choice", "", "\"front\""},

    {"mark", "of", "name or list", "", "all bodies"},
    {"mark", "shape", "choice", "", "\"plus\""},
    {"mark", "size", "number", "px", "12"},
    {"mark", "width", "number", "px", "2"},
    {"mark", "color", "colour", "", "ink"},
    {"mark", "layer", "choice", "", "\"front\""},

    {"arrow", "of", "name or list", "", "all bodies"},
    {"arrow", "quantity", "choice", "", "\"velocity\""},
    {"arrow", "scale", "number", "s, s² or s²/mass", "by quantity"},
    {"arrow", "width", "number", "px", "3"},
    {"arrow", "color", "colour", "", "by quantity"},
    {"arrow", "opacity", "number", "", "1"},
    {"arrow", "layer", "choice", "", "\"front\""},

    {"contact_mark", "of", "name or list", "", "all bodies"},
    {"contact_mark", "duration", "number", "s", "0.4"},
    {"contact_mark", "length", "number", "px", "80"},
    {"contact_mark", "width", "number", "px", "2"},
    {"contact_mark", "normal", "colour", "", "vermilion"},
    {"contact_mark", "tangent", "colour", "", "green"},
    {"contact_mark", "layer", "choice", "", "\"front\""},

    {"grid", "step", "number", "px", "a round number"},
    {"grid", "width", "number", "px", "1"},
    {"grid", "color", "colour", "", "ink, faint"},
    {"grid", "axes", "boolean", "", "true"},
    {"grid", "axis_color", "colour", "", "ink"},
    {"grid", "labels", "boolean", "", "true"},
    {"grid", "label_size", "number", "px", "13"},
    {"grid", "layer", "choice", "", "\"behind\""},

    {"ruler", "from", "[x, y] or name", "px", "required"},
    {"ruler", "to", "[x, y] or name", "px", "required"},
    {"ruler", "step", "number", "px", "a round number"},
    {"ruler", "width", "number", "px", "2"},
    {"ruler", "color", "colour", "", "ink"},
    {"ruler", "unit", "string", "", "none"},
    {"ruler", "label_size", "number", "px", "16"},
    {"ruler", "layer", "choice", "", "\"front\""},

    {"plot", "y", "value or list", "", "required"},
    {"plot", "x", "value or list", "", "\"t\""},
    {"plot", "area", "[x, y, width, height]", "px", "the upper right quarter"},
    {"plot", "title", "string", "", "none"},
    {"plot", "x_label", "string", "", "the value and its unit"},
    {"plot", "y_label", "string", "", "the value and its unit"},
    {"plot", "x_range", "[low, high]", "", "the whole run"},
    {"plot", "y_range", "[low, high]", "", "the whole run"},
    {"plot", "x_scale", "choice", "", "\"linear\""},
    {"plot", "y_scale", "choice", "", "\"linear\""},
    {"plot", "name", "string or list", "", "the values"},
    {"plot", "color", "colour or list", "", "by turns"},
    {"plot", "width", "number", "px", "2"},
    {"plot", "text_size", "number", "px", "the area's height/16"},
    {"plot", "whole", "boolean", "", "false"},
    {"plot", "cursor", "boolean", "", "true"},
    {"plot", "grid", "boolean", "", "true"},
    {"plot", "legend", "boolean", "", "with several curves"},
    {"plot", "background", "colour", "", "the scene's"},

    {"panel", "title", "string", "", "none"},
    {"panel", "color", "colour", "", "the bodies'"},
    {"panel", "seed", "integer", "", "the scene's"},
    {"panel", "clock", "table", "", "the scene's"},
    {"panel", "world", "table", "", "the scene's"},
    {"panel", "walls", "table", "", "the scene's"},
    {"panel", "body", "tables", "", "the scene's"},
    {"panel", "spawn", "tables", "", "the scene's"},
    {"panel", "launch", "tables", "", "the scene's"},
    {"panel", "collide", "tables", "", "the scene's"},
    {"panel", "force", "tables", "", "the scene's"},
    {"panel", "grid", "table", "", "the scene's"},
    {"panel", "trail", "tables", "", "the scene's"},
    {"panel", "ghost", "tables", "", "the scene's"},
    {"panel", "outline", "tables", "", "the scene's"},
    {"panel", "mark", "tables", "", "the scene's"},
    {"panel", "arrow", "tables", "", "the scene's"},
    {"panel", "contact_mark", "tables", "", "the scene's"},
    {"panel", "ruler", "tables", "", "the scene's"},
    {"panel", "plot", "tables", "", "the scene's"},
    {"panel", "text", "tables", "", "the scene's"},

    {"panels", "layout", "choice", "", "\"grid\""},
    {"panels", "columns", "integer", "", "about square"},
    {"panels", "gap", "number", "px", "16"},
    {"panels", "caption", "number", "px", "a twelfth of the height"},
    {"panels", "size", "[width, height]", "px", "of all panes"},
    {"panels", "text", "tables", "", "none"},
    {"panels", "plot", "tables", "", "none"},

    {"panels.plot", "of", "panel or list", "", "all panels"},

    {"replay", "trace", "file", "", "required"},
    {"replay", "start", "number", "s", "the first row's time"},
    {"replay", "fill", "paint", "", "\"black\""},
    {"replay", "stroke", "table", "", "none"},
    {"replay", "opacity", "number", "", "1"},
    {"replay", "look", "tables", "", "none"},

    {"replay.look", "id", "integer", "", "required"},
    {"replay.look", "group", "string", "", "required"},
    {"replay.look", "fill", "paint", "", "\"black\""},
    {"replay.look", "stroke", "table", "", "none"},
    {"replay.look", "opacity", "number", "", "1"},

    {"golden", "at", "list of numbers", "s", "required"},
    {"golden", "every", "number", "s", "required"},
    {"golden", "max_channel", "number", "1/255", "0"},
    {"golden", "max_pixels", "integer", "px", "none"},
    {"golden", "max_ratio", "number", "", "none"},
    {"golden", "max_cluster", "integer", "px", "none"},
    {"golden", "flip_max", "number", "", "none"},
    {"golden", "ssim_min", "number", "", "none"},
    {"golden", "max_forgiven", "integer", "px", "none"},
    {"golden", "ignore_antialiasing", "boolean", "", "false"},
    {"golden", "strict_alpha", "boolean", "", "false"},
    {"golden", "ignore", "list of [x, y, width, height]", "px", "none"},
    {"golden", "mask", "file or list", "", "none"},

    {"timeline", "fade_in", "number", "s", "0"},
    {"timeline", "fade_out", "number", "s", "0"},
    {"timeline", "fade_color", "colour", "", "\"black\""},

    {"section", "title", "string", "", "required"},
    {"section", "start", "number", "s", "required"},
    {"section", "card", "number", "s", "none"},
    {"section", "subtitle", "string", "", "none"},
    {"section", "narration", "file", "", "none"},

    {"caption", "text", "string", "", "required"},
    {"caption", "from", "number", "s", "required"},
    {"caption", "to", "number", "s", "none"},
    {"caption", "section", "string", "", "none"},
    {"caption", "on", "choice", "", "none"},
    {"caption", "body", "string", "", "none"},
    {"caption", "for", "number", "s", "2"},
    {"caption", "limit", "integer", "", "none"},

    {"pause", "at", "number", "s", "required"},
    {"pause", "for", "number", "s", "required"},
    {"pause", "highlight", "list of names", "", "none"},
    {"pause", "style", "choice", "", "\"ring\""},
    {"pause", "color", "colour", "", "\"#e69f00\""},

    {"speed", "from", "number", "s", "0"},
    {"speed", "to", "number", "s", "the end"},
    {"speed", "factor", "number", "", "required"},

    {"camera", "at", "number", "s", "required"},
    {"camera", "for", "number", "s", "1"},
    {"camera", "center", "[x, y] or name", "px", "the pane's middle"},
    {"camera", "zoom", "number", "", "1"},
    {"camera", "easing", "choice", "", "\"smooth\""},
    {"camera", "section", "string", "", "none"},

    {"narration", "file", "file", "", "required"},
    {"narration", "start", "number", "s", "0"},

    {"sound", "clicks", "boolean", "", "false"},
    {"sound", "loudest", "number", "px/s", "500"},

    {"poster", "at", "number", "s", "the middle of what is rendered"},
};
// clang-format on

/// Names by their length and their ends: a scene of ten thousand bodies asks half a million times.
class KeysByName {
public:
  KeysByName() {
    for (const SceneKey& key : kKeys) {
      std::vector<Named>& bucket = buckets_.at(bucketOf(key.key));
      auto named = std::ranges::find(bucket, key.key, &Named::name);
      if (named == bucket.end()) named = bucket.insert(named, Named{key.key, {}});
      named->keys.push_back(&key);
    }
  }

  [[nodiscard]] std::span<const SceneKey* const> find(std::string_view name) const {
    for (const Named& named : buckets_[bucketOf(name)])
      if (named.name == name) return named.keys;
    return {};
  }

private:
  struct Named {
    std::string_view name;
    std::vector<const SceneKey*> keys;
  };
  static constexpr std::size_t kBuckets = 256;

  static std::size_t bucketOf(std::string_view name) {
    if (name.empty()) return 0;
    const auto letter = [](char c) { return static_cast<std::size_t>(static_cast<unsigned char>(c)); };
    return (name.size() * 29 + letter(name.front()) * 5 + letter(name.back())) % kBuckets;
  }

  std::array<std::vector<Named>, kBuckets> buckets_;
};

} // namespace

std::span<const SceneKey> sceneKeyTable() {
  return kKeys;
}

std::span<const SceneKey* const> sceneKeysNamed(std::string_view key) {
  static const KeysByName kByName;
  return kByName.find(key);
}

std::vector<SceneKey> sceneKeys() {
  return {std::begin(kKeys), std::end(kKeys)};
}

} // namespace offstage
