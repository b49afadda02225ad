#include "src/sim/world.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"

#include <map>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

namespace offstage::test {
namespace {

/// Keeps the first few differences of a run.
class Differences {
public:
  template <typename... Parts>
  void add(const Parts&... parts) {
    if (++count_ > 5) return;
    (text_ << ... << parts) << '\n';
  }
  [[nodiscard]] std::string text() const {
    return count_ == 0 ? "" : text_.str() + std::to_string(count_) + " differences in all\n";
  }

private:
  std::ostringstream text_;
  std::size_t count_ = 0;
};

/// The reference numbers projectiles from 100 on, fired or not; here ids are given in order of creation.
class Ids {
public:
  explicit Ids(std::size_t bodies) : next_(static_cast<long long>(bodies)) {}
  void fired(long long reference) { shots_[reference] = next_++; }
  [[nodiscard]] long long of(long long reference) const {
    if (reference < 100) return reference;
    const auto found = shots_.find(reference);
    return found != shots_.end() ? found->second : next_; // not fired: the id that it would have had
  }

private:
  std::map<long long, long long> shots_;
  long long next_;
};

class Comparison {
public:
  Comparison(const WorldSetup& setup, const std::filesystem::path& stem, std::int64_t stride)
      : world_(setup), states_(stem.string() + ".csv.gz"), stride_(stride), ids_(setup.bodies.size()) {
    const std::filesystem::path events = stem.string() + ".events.csv.gz";
    if (std::filesystem::exists(events)) events_ = std::make_unique<ReferenceCsv>(events);
  }

  std::string run(const Clock& clock) {
    compareStates();
    for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) {
      world_.step(clock.tick(frame));
      compareEvents();
      compareStates();
    }
    if (stateRow_ != states_.rows()) {
      differences_.add("the reference has ", states_.rows() - stateRow_, " more rows");
    }
    if (events_ && eventRow_ != events_->rows()) {
      differences_.add("the reference has ", events_->rows() - eventRow_, " more events");
    }
    return differences_.text();
  }

private:
  void compare(const char* what, std::size_t row, double ours, double theirs) {
    if (sameBits(ours, theirs)) return;
    differences_.add("frame ", world_.frame(), " row ", row, ' ', what, ": ", show(ours), " instead of ",
                     show(theirs));
  }

  void compareStates() {
    if (world_.frame() % stride_ != 0) return;
    for (const Body& body : world_.bodies()) {
      if (stateRow_ >= states_.rows()) {
        differences_.add("frame ", world_.frame(), " has body ", body.id, ", the reference has no more rows");
        return;
      }
      const std::size_t row = stateRow_++;
      const long long id = ids_.of(states_.integer(row, "id"));
      if (states_.integer(row, "frame") != world_.frame() || id != body.id) {
        differences_.add("row ", row, " is frame ", states_.integer(row, "frame"), " body ", id,
                         "; here it is frame ", world_.frame(), " body ", body.id);
        continue;
      }
      compare("time", row, world_.time(), states_.hex(row, "time_hex"));
      compare("x", row, body.position.x(), states_.hex(row, "x_hex"));
      compare("y", row, body.position.y(), states_.hex(row, "y_hex"));
      compare("vx", row, body.velocity.x(), states_.hex(row, "vx_hex"));
      compare("vy", row, body.velocity.y(), states_.hex(row, "vy_hex"));
      compare("radius", row, body.radius, states_.hex(row, "radius_hex"));
    }
  }

  void compareEvents() {
    for (const Event& event : world_.events()) {
      if (!events_ || eventRow_ >= events_->rows()) {
        differences_.add("frame ", event.frame, ": ", name(event.kind), " of body ", event.first,
                         " is not in the reference");
        continue;
      }
      const std::size_t row = eventRow_++;
      const std::string& kind = events_->cell(row, "event");
      if (kind == "fire") ids_.fired(events_->integer(row, "id1"));
      long long first = ids_.of(events_->integer(row, "id1"));
      long long second = ids_.of(events_->integer(row, "id2"));
      if (second >= 0 && second < first) std::swap(first, second); // there, a shot comes before its target
      const std::string_view expected = kind == "floor" ? std::string_view("bottom") : std::string_view(kind);
      if (expected != name(event.kind) || events_->integer(row, "frame") != event.frame ||
          first != event.first || second != event.second) {
        differences_.add("event ", row, " is frame ", events_->integer(row, "frame"), ' ', kind, ' ', first,
                         ' ', second, "; here it is frame ", event.frame, ' ', name(event.kind), ' ',
                         event.first, ' ', event.second);
        continue;
      }
      compare("event time", row, event.time, events_->hex(row, "time_hex"));
      compare("event p", row, event.p, events_->hex(row, "p_hex"));
      compare("event q", row, event.q, events_->hex(row, "q_hex"));
    }
  }

  World world_;
  ReferenceCsv states_;
  std::unique_ptr<ReferenceCsv> events_;
  std::int64_t stride_;
  Ids ids_;
  std::size_t stateRow_ = 0;
  std::size_t eventRow_ = 0;
  Differences differences_;
};

} // namespace

std::string compareWithOracle(const WorldSetup& setup, const Clock& clock, const std::filesystem::path& stem,
                              std::int64_t stride) {
  return Comparison(setup, stem, stride).run(clock);
}

} // namespace offstage::test
