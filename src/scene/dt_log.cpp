#include "src/scene/dt_log.h"

#include "src/scene/diagnostic.h"
#include "src/scene/limits.h"
#include "src/scene/quote.h"
#include "src/scene/text_file.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// At 240 frames a second this is a recording of more than eight hours.
constexpr std::size_t kLongestLog = std::size_t{64} << 20U;
constexpr std::int64_t kLongestTotal = static_cast<std::int64_t>(kMaxDuration) * 1'000'000'000;

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

/// "# now", with any blanks around and between.
bool announcesTimestamps(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('#') && trimmed(line.substr(1)) == "now";
}

class LogParser {
public:
  explicit LogParser(const std::filesystem::path& file) : file_(file.string()) {}

  std::vector<std::int64_t> parse(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // the byte order mark of some editors
    timestamps_ = announcesTimestamps(text.substr(0, text.find('\n')));
    std::uint32_t number = 0;
    while (!text.empty() && !full()) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
      readLine(line, ++number);
    }
    if (diagnostics_.empty() && durations_.empty()) {
      report(0, 0,
             timestamps_ ? "the log holds no frame; it needs at least two timestamps"
                         : "the log holds no frame; it needs at least one duration in nanoseconds");
    }
    if (!diagnostics_.empty()) throw SceneError(std::move(diagnostics_));
    return std::move(durations_);
  }

private:
  void report(std::uint32_t line, std::uint32_t column, const std::string& message) {
    diagnostics_.push_back({{file_, line, column}, message});
  }

  [[nodiscard]] bool full() const { return diagnostics_.size() >= kMaxDiagnostics; }

  void readLine(std::string_view line, std::uint32_t number) {
    const std::string_view word = trimmed(line);
    if (word.empty() || word.starts_with('#')) return;
    const auto column = static_cast<std::uint32_t>(word.data() - line.data()) + 1;

    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) {
      report(number, column, fmt::format("{} is more than 64 bits hold", quotedText(word)));
    } else if (error != std::errc() || end != word.data() + word.size()) {
      report(number, column, fmt::format("{} is not a whole number of nanoseconds", quotedText(word)));
    } else if (timestamps_) {
      addTimestamp(value, number, column);
    } else {
      addDuration(value, number, column);
    }
  }

  void addTimestamp(std::int64_t now, std::uint32_t line, std::uint32_t column) {
    if (now < 0) {
      report(line, column, fmt::format("a timestamp must be at least 0, but it is {}", now));
      return;
    }
    if (previous_ && now < *previous_) {
      report(line, column,
             fmt::format("timestamps must not go back, but {} comes after {}", now, *previous_));
      return;
    }
    if (previous_) addDuration(now - *previous_, line, column);
    previous_ = now;
  }

  void addDuration(std::int64_t duration, std::uint32_t line, std::uint32_t column) {
    if (duration < 0) {
      report(line, column, fmt::format("a frame's duration must be at least 0 ns, but it is {}", duration));
    } else if (duration > kLongestTotal - total_) {
      const char* hint = timestamps_ ? "" : "; a log of raw timestamps needs the first line '# now'";
      report(line, column, fmt::format("a log may last at most {} s in all{}", kMaxDuration, hint));
    } else {
      total_ += duration;
      durations_.push_back(duration);
    }
  }

  std::string file_;
  bool timestamps_ = false;
  std::optional<std::int64_t> previous_;
  std::int64_t total_ = 0;
  std::vector<std::int64_t> durations_;
  std::vector<Diagnostic> diagnostics_;
};

} // namespace

std::vector<std::int64_t> readDtLog(const std::filesystem::path& file) {
  return parseDtLog(readTextFile(file, kLongestLog, "a dt log"), file);
}

std::vector<std::int64_t> parseDtLog(std::string_view text, const std::filesystem::path& file) {
  return LogParser(file).parse(text);
}

} // namespace offstage
