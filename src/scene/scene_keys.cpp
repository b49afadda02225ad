#include "src/scene/scene_keys.h"

namespace offstage {
namespace {

// clang-format off
constexpr SceneKey kKeys[] = {
    // table, key, type, unit, default
    {"", "title", "string", "", "the file's name without its ending"},
    {"", "duration", "number", "s", "10"},
    {"", "seed", "integer", "", "0"},
    {"", "frame", "table", "", "none"},
    {"", "clock", "table", "", "none"},
    {"", "world", "table", "", "none"},
    {"", "walls", "table", "", "none"},
    {"", "view", "table", "", "none"},
    {"", "body", "tables", "", "none"},
    {"", "spawn", "tables", "", "none"},
    {"", "launch", "tables", "", "none"},
    {"", "collide", "tables", "", "none"},
    {"", "force", "tables", "", "none"},
    {"", "replay", "table", "", "none"},
    {"", "golden", "table", "", "none"},

    {"frame", "size", "[width, height]", "px", "[640, 480]"},
    {"frame", "background", "colour", "", "\"white\""},
    {"frame", "scale", "number", "", "1"},

    {"clock", "fps", "number", "1/s", "60"},
    {"clock", "recorded", "file", "", "none"},
    {"clock", "substeps", "integer", "", "1"},

    {"world", "gravity", "[x, y]", "px/s²", "[0, 9.8]"},
    {"world", "integrator", "choice", "", "\"semi-implicit-euler\""},
    {"world", "contacts", "choice", "", "\"lecture\""},
    {"world", "iterations", "integer", "", "1"},

    {"walls", "left", "number", "", "open"},
    {"walls", "right", "number", "", "open"},
    {"walls", "top", "number", "", "open"},
    {"walls", "bottom", "number", "", "open"},
    {"walls", "all", "number", "", "open"},
    {"walls", "clamp", "boolean", "", "true"},

    {"view", "pixels_per_metre", "number", "px", "1"},
    {"view", "origin", "[x, y]", "px", "[0, 0]"},
    {"view", "y_up", "boolean", "", "false"},

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
    {"spawn", "restitution", "number", "", "1"},
    {"spawn", "friction", "number", "", "0"},
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
};
// clang-format on

} // namespace

std::span<const SceneKey> sceneKeyTable() {
  return kKeys;
}

std::vector<SceneKey> sceneKeys() {
  return {std::begin(kKeys), std::end(kKeys)};
}

} // namespace offstage
