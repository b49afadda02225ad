#include "render/compare/golden_states.h"

#include "src/scene/diagnostic.h"
#include "src/scene/text_file.h"
#include "src/scene/trace.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kMostRows = 1000;
constexpr std::size_t kHashesALine = 30;
constexpr std::size_t kLargestFile = std::size_t{256} << 20U;
constexpr std::string_view kTitle = "# offstage golden states 1: frames 0 to ";
constexpr std::string_view kHashes = "# hashes of frame ";

std::uint32_t shortened(std::uint64_t stateHash) {
  return static_cast<std::uint32_t>(stateHash & 0xffffffU);
}

/// Reads the remarks before the rows.
class HeadReader {
public:
  HeadReader(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file.string()) {}

  GoldenStates read() {
    GoldenStates states;
    if (!take(kTitle)) fail("this is no file of golden states");
    const std::int64_t last = number();
    if (!take(", stride ")) fail("a stride is missing here");
    states.stride = number();
    if (last < 0 || states.stride < 1) fail("the numbers of this line cannot be");
    if (take(", and")) {
      while (take(" ")) states.also.push_back(number());
    }
    nextLine();
    while (take(kHashes)) {
      if (number() != static_cast<std::int64_t>(states.hashes.size())) fail("these hashes belong elsewhere");
      if (!take(":")) fail("a colon is missing here");
      while (take(" ")) states.hashes.push_back(hash());
      nextLine();
    }
    if (static_cast<std::int64_t>(states.hashes.size()) != last + 1)
      fail(fmt::format("{} hashes stand here for {} frames", states.hashes.size(), last + 1));
    return states;
  }

private:
  bool take(std::string_view wanted) {
    if (!text_.substr(at_).starts_with(wanted)) return false;
    at_ += wanted.size();
    return true;
  }

  template <typename Value>
  Value parsed(int base, std::string_view what) {
    Value value{};
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value, base);
    if (error != std::errc{}) fail(what);
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  std::int64_t number() { return parsed<std::int64_t>(10, "a whole number is missing here"); }
  std::uint32_t hash() { return parsed<std::uint32_t>(16, "a hash is missing here"); }

  void nextLine() {
    take("\r");
    if (!take("\n")) fail("this line is too long or cut short");
    ++line_;
    lineStart_ = at_;
  }

  [[noreturn]] void fail(std::string_view problem) const {
    throw SceneError(
        {{{file_, line_, static_cast<std::uint32_t>(at_ - lineStart_) + 1}, std::string(problem)}});
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t lineStart_ = 0;
  std::uint32_t line_ = 1;
};

void append(Trace& trace, std::int64_t frame, double time, std::span<const Body> bodies) {
  if (bodies.empty()) return;
  trace.frames.push_back({frame, time, trace.rows.size(), bodies.size()});
  for (const Body& body : bodies) {
    TraceRow& row = trace.rows.emplace_back();
    row.frame = frame;
    row.id = body.id;
    row.time = time;
    row.x = body.position.x();
    row.y = body.position.y();
    row.vx = body.velocity.x();
    row.vy = body.velocity.y();
    row.radius = body.radius;
  }
}

} // namespace

bool GoldenStates::keeps(std::int64_t frame) const {
  return frame % stride == 0 || std::binary_search(also.begin(), also.end(), frame);
}

GoldenStates readGoldenStates(const std::filesystem::path& file) {
  return parseGoldenStates(readTextFile(file, kLargestFile, "a file of golden states"), file);
}

GoldenStates parseGoldenStates(std::string_view text, const std::filesystem::path& file) {
  GoldenStates states = HeadReader(text, file).read();
  states.trace = parseTrace(text, file);
  return states;
}

GoldenRecorder::GoldenRecorder(std::vector<std::string> groups, std::vector<std::int64_t> goldenFrames)
    : groups_(std::move(groups)), goldenFrames_(std::move(goldenFrames)) {
  std::sort(goldenFrames_.begin(), goldenFrames_.end());
  goldenFrames_.erase(std::unique(goldenFrames_.begin(), goldenFrames_.end()), goldenFrames_.end());
}

void GoldenRecorder::add(std::int64_t frame, double time, std::uint64_t stateHash,
                         std::span<const Body> bodies) {
  hashes_.push_back(shortened(stateHash));
  const bool golden = std::binary_search(goldenFrames_.begin(), goldenFrames_.end(), frame);
  if (golden) goldens_.emplace(frame, Kept{time, {bodies.begin(), bodies.end()}});
  if (frame % stride_ != 0) return;
  rows_ += bodies.size();
  kept_.emplace(frame, Kept{time, {bodies.begin(), bodies.end()}});
  while (rows_ > kMostRows && kept_.size() > 1) {
    stride_ *= 2;
    std::erase_if(kept_, [this](const auto& one) {
      if (one.first % stride_ == 0) return false;
      rows_ -= one.second.bodies.size();
      return true;
    });
  }
}

std::string GoldenRecorder::text() const {
  std::ostringstream out;
  out << kTitle << static_cast<std::int64_t>(hashes_.size()) - 1 << ", stride " << stride_;
  if (!goldenFrames_.empty()) out << ", and " << fmt::format("{}", fmt::join(goldenFrames_, " "));
  for (std::size_t frame = 0; frame < hashes_.size(); ++frame) {
    if (frame % kHashesALine == 0) out << '\n' << kHashes << frame << ':';
    out << fmt::format(" {:06x}", hashes_[frame]);
  }
  out << '\n';
  TraceWriter writer(out, TraceFormat::Csv, groups_);
  std::map<std::int64_t, const Kept*> all;
  for (const auto& [frame, kept] : kept_) all.emplace(frame, &kept);
  for (const auto& [frame, kept] : goldens_) all.emplace(frame, &kept);
  for (const auto& [frame, kept] : all) writer.write(frame, kept->time, kept->bodies);
  return out.str();
}

void StatesWatch::add(std::int64_t frame, double time, std::uint64_t stateHash,
                      std::span<const Body> bodies) {
  const auto index = static_cast<std::size_t>(frame);
  const bool recorded = index < recorded_.hashes.size();
  if (!firstFrame_ && recorded && recorded_.hashes[index] != shortened(stateHash)) firstFrame_ = frame;
  if (recorded && recorded_.keeps(frame)) append(actual_, frame, time, bodies);
}

StatesDifference StatesWatch::difference() const {
  return {firstFrame_, compareTraces(recorded_.trace, actual_, {}, TraceMatch::Id)};
}

} // namespace offstage
