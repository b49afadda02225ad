#include "src/scene/parse_body.h"
#include "src/scene/parse_look.h"

#include <cmath>
#include <limits>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<Spawner::Count> kCounts[] = {{"spawned", Spawner::Count::Spawned},
                                              {"alive", Spawner::Count::Alive}};
constexpr Choice<Spawner::When> kWhens[] = {{"before-update", Spawner::When::BeforeUpdate},
                                            {"after-update", Spawner::When::AfterUpdate}};

/// A number's generator: exactly one of int, spread, uniform, gaussian. `allowed` holds for what the user
/// chooses, not for what chance makes of it (a gaussian radius may be drawn below 0 and then is 0).
std::optional<Number> readGenerator(const TableReader& keys, const std::string& what, Range allowed) {
  std::vector<std::string_view> given;
  for (const std::string_view key : {"int", "spread", "uniform", "gaussian"}) {
    if (keys.has(key)) given.push_back(key);
  }
  if (given.empty()) {
    keys.errors().add(keys.value(),
                      fmt::format("{} needs one of 'int', 'spread', 'uniform' or 'gaussian'", what));
    return std::nullopt;
  }
  if (given.size() > 1) {
    keys.rejectBoth(given[1], given[0]);
    return std::nullopt;
  }
  if (keys.has("int")) {
    const auto bound = keys.givenInteger("int", 1, std::numeric_limits<std::int32_t>::max());
    if (!bound) return std::nullopt;
    return IntegerNumber{static_cast<std::int32_t>(*bound)};
  }
  if (keys.has("spread")) {
    const auto half = keys.givenNumber("spread", Range::atLeast(0.0));
    if (!half) return std::nullopt;
    return SpreadNumber{*half};
  }
  if (keys.has("uniform")) {
    const auto bounds = keys.givenNumbers<2>("uniform", allowed);
    if (!bounds) return std::nullopt;
    if ((*bounds)[0] > (*bounds)[1]) {
      keys.reject("uniform", "must be [low, high] with low not above high");
      return std::nullopt;
    }
    return UniformNumber{(*bounds)[0], (*bounds)[1]};
  }
  const auto parameters = keys.givenNumbers<2>("gaussian");
  if (!parameters) return std::nullopt;
  const auto [mean, deviation] = *parameters;
  if (!allowed.contains(mean)) {
    keys.reject("gaussian", fmt::format("must be [mean, deviation] with the mean {}", allowed.text()));
    return std::nullopt;
  }
  if (deviation < 0.0) {
    keys.reject("gaussian", "must be [mean, deviation] with the deviation at least 0");
    return std::nullopt;
  }
  return GaussianNumber{mean, deviation};
}

bool isFinite(const Number& number) {
  struct Finite {
    bool operator()(const ConstantNumber& n) const { return std::isfinite(n.value); }
    bool operator()(const IntegerNumber& /*n*/) const { return true; }
    bool operator()(const SpreadNumber& n) const { return std::isfinite(n.half); }
    bool operator()(const UniformNumber& n) const { return std::isfinite(n.low) && std::isfinite(n.high); }
    bool operator()(const GaussianNumber& n) const {
      return std::isfinite(n.mean) && std::isfinite(n.deviation);
    }
  };
  return std::visit(Finite{}, number);
}

/// Reads the numbers of one [[spawn]], in the scene's units, and maps them onto pixels.
class NumberReader {
public:
  NumberReader(SceneBuilder& builder, const TableReader& reader) : builder_(builder), reader_(reader) {}

  /// The key's number; `fallback` (in pixels) when it is absent or wrong.
  Number read(std::string_view key, Range allowed, const AffineMap& map, double fallback) const {
    const TomlValue* value = reader_.find(key);
    if (value == nullptr) return ConstantNumber{fallback};
    return readValue(*value, key, reader_.described(key), allowed, map, fallback);
  }

  /// The number of a value of the key, which `what` names in messages.
  Number readValue(const TomlValue& value, std::string_view key, const std::string& what, Range allowed,
                   const AffineMap& map, double fallback) const {
    const auto number = readInSceneUnits(value, key, what, allowed);
    if (!number) return ConstantNumber{fallback};
    const auto result = mapped(*number, map);
    if (!result) {
      reader_.reject(
          key, "cannot be { int = … } under this [view]: it draws whole pixels; use { uniform = [a, b] }");
      return ConstantNumber{fallback};
    }
    if (!isFinite(*result)) reader_.reject(key, "is too large for this [view]");
    return *result;
  }

  /// Two numbers that may also be given as one pair: x and y or center, vx and vy or velocity.
  /// Returns whether the pair was given.
  bool readPair(std::string_view pairKey, std::string_view firstKey, std::string_view secondKey,
                Range allowed, const AffineMap& firstMap, const AffineMap& secondMap, Number& first,
                Number& second) const {
    // Read even beside the pair, so that what is wrong with them is said too.
    first = read(firstKey, allowed, firstMap, 0.0);
    second = read(secondKey, allowed, secondMap, 0.0);
    if (!reader_.has(pairKey)) return false;
    reader_.rejectBoth(firstKey, pairKey);
    reader_.rejectBoth(secondKey, pairKey);
    const TomlValue& value = *reader_.find(pairKey);
    const TomlValue::Array* both = value.array();
    if (both == nullptr || both->size() != 2) {
      reportMismatch(value, reader_.described(pairKey), "an array of 2 numbers, each of which may be random",
                     builder_.errors);
      return true;
    }
    const auto one = [&](std::size_t index, const AffineMap& map) {
      return readValue((*both)[index], pairKey,
                       fmt::format("value {} of {}", index + 1, reader_.described(pairKey)), allowed, map,
                       0.0);
    };
    first = one(0, firstMap);
    second = one(1, secondMap);
    return true;
  }

  /// The same for a pair that must be given in one of its forms.
  void requirePair(std::string_view pairKey, std::string_view firstKey, std::string_view secondKey,
                   Range allowed, const AffineMap& firstMap, const AffineMap& secondMap, Number& first,
                   Number& second) const {
    if (readPair(pairKey, firstKey, secondKey, allowed, firstMap, secondMap, first, second)) return;
    const bool hasFirst = reader_.has(firstKey);
    const bool hasSecond = reader_.has(secondKey);
    if (!hasFirst && !hasSecond) {
      builder_.errors.add(reader_.value(), fmt::format("[[spawn]] needs '{}' and '{}', or '{}'", firstKey,
                                                       secondKey, pairKey));
    } else if (!hasFirst || !hasSecond) {
      reader_.require(hasFirst ? secondKey : firstKey);
    }
  }

private:
  std::optional<Number> readInSceneUnits(const TomlValue& value, std::string_view key,
                                         const std::string& what, Range allowed) const {
    if (value.table() != nullptr) {
      const TableReader keys(value, {"random"}, reader_.label(), builder_.errors, std::string(key) + '.');
      return readGenerator(keys, what, allowed);
    }
    const bool isNumber =
        std::holds_alternative<double>(value.data) || std::holds_alternative<std::int64_t>(value.data);
    if (!isNumber) {
      reportMismatch(value, what, "a number or a random number such as { int = 640 }", builder_.errors);
      return std::nullopt;
    }
    const auto constant = readNumber(value, what, allowed, builder_.errors);
    if (!constant) return std::nullopt;
    return ConstantNumber{*constant};
  }

  SceneBuilder& builder_;
  const TableReader& reader_;
};

} // namespace

void parseSpawn(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"spawn"}, "[[spawn]]", builder.errors);
  const NumberReader numbers(builder, reader);
  const View& view = builder.view;
  Spawner spawner;
  spawner.every = reader.number("every", Range::above(0.0));
  spawner.count = reader.choice("count", kCounts);
  spawner.when = reader.choice("when", kWhens);
  spawner.limit = reader.givenInteger("limit", 0, std::numeric_limits<std::int64_t>::max());

  Body& body = spawner.prototype;
  body.spawner = static_cast<std::uint32_t>(builder.scene.world.spawners.size());
  const bool shapeKnown = readBodyProperties(builder, reader, body);
  spawner.looks = readLooks(builder, reader, body, true);
  body.look = spawner.looks.front();

  if (shapeKnown) {
    rejectKeysOfOtherShape(reader, body.shape, {"center", "radius"}, {"position", "size", "width", "height"});
    const bool isCircle = body.shape == Shape::Circle;
    numbers.requirePair(isCircle ? "center" : "position", "x", "y", Range::any(), view.x(), view.y(),
                        spawner.x, spawner.y);
    if (isCircle) {
      if (!reader.has("radius")) reader.require("radius");
      spawner.radius = numbers.read("radius", Range::atLeast(0.0), view.length(), 0.0);
    } else {
      numbers.requirePair("size", "width", "height", Range::atLeast(0.0), view.length(), view.length(),
                          spawner.width, spawner.height);
    }
  }
  numbers.readPair("velocity", "vx", "vy", Range::any(), view.vectorX(), view.vectorY(), spawner.vx,
                   spawner.vy);
  numbers.readPair("acceleration", "ax", "ay", Range::any(), view.vectorX(), view.vectorY(), spawner.ax,
                   spawner.ay);
  spawner.mass = numbers.read("mass", Range::above(0.0), AffineMap{}, 1.0);
  if (reader.has("restitution"))
    spawner.restitution = numbers.read("restitution", kRestitutions, AffineMap{}, 1.0);
  if (reader.has("friction")) spawner.friction = numbers.read("friction", kFrictions, AffineMap{}, 0.0);
  builder.scene.world.spawners.push_back(std::move(spawner));
  builder.spawnTables.push_back(&table);
}

} // namespace offstage
