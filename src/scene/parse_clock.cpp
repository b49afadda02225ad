#include "src/scene/parse_clock.h"

#include "src/scene/dt_log.h"
#include "src/scene/limits.h"
#include "src/scene/quote.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// A duration that is k/fps up to rounding is meant to be k steps, not k + 1.
constexpr double kStepTolerance = 1e-6;

/// The number that a command line gives in place of the scene's, held to the same range.
std::optional<double> overriding(std::optional<double> given, std::string_view what, Range allowed,
                                 ErrorList& errors) {
  if (!given) return std::nullopt;
  if (std::isfinite(*given) && allowed.contains(*given)) return given;
  errors.add(fmt::format("the {} given for this run must be {}, but it is {}", what, allowed.text(),
                         numberText(*given)));
  return std::nullopt;
}

constexpr Choice<Stepping::Form> kForms[] = {{"variable", Stepping::Form::Variable},
                                             {"fixed", Stepping::Form::Fixed},
                                             {"clamped", Stepping::Form::Clamped},
                                             {"accumulator", Stepping::Form::Accumulator}};

Stepping readStepping(const TableReader& reader) {
  Stepping stepping;
  stepping.form = reader.choice("step", kForms);
  const auto dt = reader.givenNumber("dt", Range::between(kMinStep, kMaxStep));
  if (dt && stepping.form == Stepping::Form::Variable)
    reader.reject(
        "dt",
        "belongs to the steps \"fixed\", \"clamped\" and \"accumulator\"; with \"variable\" a step is as "
        "long as its frame");
  if (dt) stepping.dt = *dt;
  return stepping;
}

std::optional<Clock> readRecording(const std::filesystem::path& file, ErrorList& errors) {
  try {
    return Clock::recorded(readDtLog(file));
  } catch (const SceneError& problems) {
    errors.add(problems);
  }
  return std::nullopt;
}

} // namespace

void parseClock(SceneBuilder& builder, const TomlValue* table, const TableReader& top,
                const SceneOverrides& overrides) {
  const TomlValue absent{TomlValue::Table{}, 0, 0};
  const TableReader reader(table != nullptr ? *table : absent, {"clock"}, "[clock]", builder.errors);
  const Range fpsRange = Range::aboveUpTo(0.0, kMaxFps);
  const Range durationRange = Range::between(0.0, kMaxDuration);

  reader.rejectBoth("recorded", "fps");
  builder.scene.world.stepping = readStepping(reader);
  builder.substepsGiven = reader.has("substeps");
  builder.scene.world.substeps = static_cast<int>(reader.integer("substeps", 1, kMaxSubsteps));
  double fps = reader.number("fps", fpsRange);
  if (const auto given = overriding(overrides.fps, "fps", fpsRange, builder.errors)) fps = *given;

  const bool hasDuration = top.has("duration") || overrides.duration.has_value();
  double duration = top.number("duration", durationRange);
  if (const auto given = overriding(overrides.duration, "duration", durationRange, builder.errors)) {
    duration = *given;
  }

  std::optional<std::filesystem::path> log = overrides.dtLog;
  if (!log && reader.has("recorded")) {
    log = builder.readFile(reader, "recorded");
    if (!log) return;
  }
  if (log) {
    builder.scene.files.push_back(*log);
    const auto recording = readRecording(*log, builder.errors);
    if (!recording) return;
    builder.scene.clock = hasDuration ? recording->truncated(recording->frameAt(duration)) : *recording;
    return;
  }
  const double steps = std::ceil(duration * fps - kStepTolerance);
  builder.scene.clock = Clock::fixed(fps, steps > 0.0 ? static_cast<std::int64_t>(steps) : 0);
}

} // namespace offstage
