#include "src/scene/replay.h"

#include "src/sim/state_hash.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace offstage {
namespace {

constexpr double kEvenly = 1e-6; ///< s: times this near to k/fps are meant to be k/fps

/// The least distance between two neighbouring frames' numbers: how often the program wrote.
std::int64_t strideOf(const Trace& trace) {
  std::int64_t stride = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 1; i < trace.frames.size(); ++i)
    stride = std::min(stride, trace.frames[i].number - trace.frames[i - 1].number);
  return stride;
}

} // namespace

std::vector<Replay::Frame> replayFrames(const Trace& trace, std::optional<double> start) {
  const double origin = start.value_or(trace.frames.front().time);
  const std::int64_t stride = strideOf(trace);
  std::vector<Replay::Frame> frames;
  if (origin < trace.frames.front().time) frames.push_back({0.0, 0, 0});
  const auto add = [&](double time, std::size_t first, std::size_t count) {
    // What began before the start is on show at it, until the next one takes its place.
    if (time <= origin) frames.clear();
    frames.push_back({std::max(time - origin, 0.0), first, count});
  };
  for (std::size_t i = 0; i < trace.frames.size(); ++i) {
    const TraceFrame& frame = trace.frames[i];
    add(frame.time, frame.first, frame.count);
    if (i + 1 == trace.frames.size()) break;
    const TraceFrame& next = trace.frames[i + 1];
    const std::int64_t distance = next.number - frame.number;
    if (distance == stride) continue;
    add(frame.time + (next.time - frame.time) * static_cast<double>(stride) / static_cast<double>(distance),
        0, 0);
  }
  return frames;
}

Clock replayClock(const std::vector<Replay::Frame>& frames, bool mayBeFixed) {
  const auto steps = static_cast<std::int64_t>(frames.size()) - 1;
  const double fps = std::round(static_cast<double>(steps) / frames.back().time);
  bool evenly = mayBeFixed && std::isfinite(fps) && fps >= 1.0;
  for (std::size_t i = 0; evenly && i < frames.size(); ++i)
    evenly = std::abs(frames[i].time - static_cast<double>(i) / fps) <= kEvenly;
  if (evenly) return Clock::fixed(fps, steps);

  std::vector<std::int64_t> durations;
  std::int64_t before = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::int64_t now = std::llround(frames[i].time * 1e9);
    durations.push_back(now - before);
    before = now;
  }
  return Clock::recorded(durations);
}

ReplayMotion::ReplayMotion(std::shared_ptr<const Replay> replay) : replay_(std::move(replay)) {
  takeBodies();
}

void ReplayMotion::step(const Tick& tick) {
  if (tick.frame != frame_ + 1) throw std::invalid_argument("ReplayMotion::step: not the next frame");
  frame_ = tick.frame;
  time_ = tick.time;
  takeBodies();
}

void ReplayMotion::takeBodies() {
  const Replay::Frame& frame = replay_->frames.at(static_cast<std::size_t>(frame_));
  bodies_.clear();
  for (std::size_t i = frame.first; i < frame.first + frame.count; ++i) {
    const TraceRow& row = replay_->trace.rows[i];
    Body body;
    body.id = static_cast<std::uint32_t>(row.id);
    body.group = row.group;
    body.look = replay_->looks[i];
    body.position = {row.x, row.y};
    body.velocity = {row.vx, row.vy};
    body.radius = row.radius;
    bodies_.push_back(body);
  }
}

std::uint64_t ReplayMotion::stateHash() const {
  StateHash hash(time_);
  for (const Body& body : bodies_)
    hash.add(body.id, body.shape, body.position, body.velocity, body.radius, body.size);
  return hash.value();
}

} // namespace offstage
