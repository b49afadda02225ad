#include "render/stage/stage_source.h"

#include "render/job/fingerprint.h"
#include "src/scene/dt_log.h"
#include "src/scene/limits.h"
#include "src/sim/error.h"
#include "src/sim/state_hash.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr double kMaxSteps = 1e8; ///< keeps an absurd duration from overflowing a frame number

Settings checked(const Settings& settings) {
  if (settings.size[0] < 1 || settings.size[1] < 1)
    throw Error(ExitCode::BadInput, fmt::format("the exercise's size {}x{} is not at least 1x1",
                                                settings.size[0], settings.size[1]));
  return settings;
}

/// An exercise has no forces but what it computes itself, so an arrow shows a body's own acceleration.
WorldSetup withoutForces() {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  return setup;
}

Clock makeClock(const Settings& settings, const RenderOptions& options) {
  const double duration = options.duration.value_or(settings.duration);
  if (options.dtLog) {
    const Clock clock = Clock::recorded(readDtLog(*options.dtLog));
    return options.duration ? clock.truncated(clock.frameAt(duration)) : clock;
  }
  const double fps = options.fps.value_or(settings.fps);
  const double steps = std::ceil(duration * fps - 1e-6);
  if (!(duration > 0.0) || !(steps <= kMaxSteps))
    throw Error(ExitCode::BadInput,
                fmt::format("a duration of {} s at {} frames a second is not from 1 to {} frames", duration,
                            fps, static_cast<std::int64_t>(kMaxSteps)));
  return Clock::fixed(fps, static_cast<std::int64_t>(steps));
}

} // namespace

StageSource::StageSource(std::unique_ptr<Exercise> exercise, const RenderOptions& options)
    : exercise_(std::move(exercise)),
      clock_(makeClock(exercise_->settings(), options)),
      stage_(checked(exercise_->settings()), options.seed.value_or(exercise_->settings().seed)),
      painter_(options.viewport(stage_.width(), stage_.height(), options.scale.value_or(1.0)),
               stage_.settings_.background),
      history_(Overlays{}),
      overlays_(Overlays{}, withoutForces()),
      textPainter_(painter_.viewport()) {
  if (options.input) stage_.input_.log_ = std::make_shared<const InputLog>(InputLog::read(*options.input));
  inputFile_ = options.input.value_or("");
  stage_.input_.advance(0.0);
  exercise_->start(stage_);
  noteFrame();
}

void StageSource::watch(WarningLog& log) {
  log_ = &log;
  checkShapes();
}

void StageSource::checkShapes() {
  if (log_ == nullptr) return;
  std::optional<Warning> warning = findNotFinite(bodies_);
  if (!warning) return;
  warning->frame = stage_.frame();
  warning->time = stage_.time();
  std::exchange(log_, nullptr)->report(*warning, WarningText());
}

void StageSource::step() {
  stage_.now_ = clock_.tick(stage_.frame() + 1);
  stage_.input_.advance(stage_.now_.time);
  exercise_->frame(stage_, stage_.now_.dt);
  noteFrame();
}

void StageSource::noteFrame() {
  prepareLooks();
  checkTexts();
  if (stage_.overlaysChanged_) {
    stage_.overlaysChanged_ = false;
    history_.setOverlays(stage_.overlays_);
    overlays_ = OverlayPainter(stage_.overlays_, withoutForces());
  }
  bodies_.clear();
  for (const Stage::Entry& entry : stage_.entries_) {
    const Node::State& node = *entry.node.state_;
    Body body;
    body.id = entry.id;
    body.shape = node.shape;
    body.position = node.position;
    body.size = node.size;
    body.radius = node.radius;
    body.velocity = node.velocity;
    body.acceleration = node.acceleration;
    body.look = entry.look;
    if (node.visible) bodies_.push_back(body);
  }
  history_.note(stage_.time(), bodies_, {});
  checkShapes();
}

void StageSource::draw(Picture& picture) const {
  const OverlayPainter::Now now{stage_.time(), bodies_, history_, painter_, textPainter_};
  painter_.begin(picture);
  overlays_.paint(picture, OverlayLayer::Behind, now);
  for (const Stage::Entry& entry : stage_.entries_) {
    const Node::State& node = *entry.node.state_;
    if (!node.visible) continue;
    if (node.shape == Shape::Circle)
      painter_.circle(picture, node.position, node.radius, entry.look);
    else
      painter_.rectangle(picture, node.position, node.size, entry.look);
  }
  overlays_.paint(picture, OverlayLayer::Front, now);
  for (const Stage::TextEntry& entry : stage_.texts_) {
    const Text::State& text = *entry.text.state_;
    // One that moves down or up stands between whole pixels most of the time.
    const bool smooth = text.position.y() != std::floor(text.position.y());
    if (text.visible) textPainter_.draw(picture, text.text, text.look, text.position, 1.0, smooth);
  }
}

std::uint64_t StageSource::stateHash() const {
  StateHash hash(stage_.time());
  for (const Stage::Entry& entry : stage_.entries_) {
    const Node::State& node = *entry.node.state_;
    hash.add(entry.id, node.shape, node.position, node.velocity, node.radius, node.size);
  }
  return hash.value();
}

std::uint64_t StageSource::fingerprint() const {
  Fingerprint fingerprint;
  fingerprint.add(clock_);
  if (!inputFile_.empty()) fingerprint.addFile(inputFile_);
  return fingerprint.value();
}

void StageSource::checkTexts() {
  for (Stage::TextEntry& entry : stage_.texts_) {
    const Text::State& text = *entry.text.state_;
    if (entry.checked == text.version) continue;
    if (!(text.look.size >= kLeastTextSize && text.look.size <= kMostTextSize))
      throw Error(ExitCode::BadInput, fmt::format("a text's size {} px is not from {} to {}", text.look.size,
                                                  kLeastTextSize, kMostTextSize));
    textPainter_.require(text.look, text.text);
    entry.checked = text.version;
  }
}

void StageSource::prepareLooks() {
  for (Stage::Entry& entry : stage_.entries_) {
    const Node::State& node = *entry.node.state_;
    if (entry.look == Stage::kNoLook) {
      // Trails and ghosts of shapes that are gone still show their looks.
      const bool remembers = !stage_.overlays_.trails.empty() || !stage_.overlays_.ghosts.empty();
      if (stage_.freeLooks_.empty() || remembers) {
        entry.look = painter_.addLook(node.look);
      } else {
        entry.look = stage_.freeLooks_.back();
        stage_.freeLooks_.pop_back();
        painter_.setLook(entry.look, node.look);
      }
    } else if (entry.lookVersion != node.lookVersion) {
      painter_.setLook(entry.look, node.look);
    } else {
      continue;
    }
    entry.lookVersion = node.lookVersion;
  }
}

} // namespace offstage
