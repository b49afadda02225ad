#include "src/scene/input_log.h"

#include "src/scene/error_list.h"
#include "src/scene/quote.h"
#include "src/scene/text_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Hours of a pointer that never rests.
constexpr std::size_t kLongestLog = std::size_t{64} << 20U;
constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::size_t kMostWords = 4;

struct Word {
  std::string_view text;
  std::uint32_t column = 0;
};

class LogParser {
public:
  explicit LogParser(const std::filesystem::path& file) : errors_(file.string()) {}

  std::vector<InputEvent> parse(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // the byte order mark of some editors
    for (line_ = 1; !text.empty() && !errors_.full(); ++line_) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
      readLine(line);
    }
    errors_.throwIfAny();
    return std::move(events_);
  }

private:
  void reject(std::uint32_t column, std::string message) { errors_.add(line_, column, std::move(message)); }

  void readLine(std::string_view line) {
    std::array<Word, kMostWords> words;
    std::size_t count = 0;
    std::size_t at = line.find_first_not_of(kBlanks);
    if (at == std::string_view::npos || line[at] == '#') return;
    while (at != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      if (count == kMostWords)
        return reject(static_cast<std::uint32_t>(at) + 1,
                      fmt::format("{} is too much here", quotedText(line.substr(at, end - at))));
      words[count++] = {line.substr(at, end - at), static_cast<std::uint32_t>(at) + 1};
      at = line.find_first_not_of(kBlanks, end);
    }

    InputEvent event;
    const std::optional<double> time = number(words[0], "a time in s");
    if (!time) return;
    if (*time < 0.0)
      return reject(words[0].column, fmt::format("a time must be at least 0, but it is {}", *time));
    if (!events_.empty() && *time < events_.back().time)
      return reject(words[0].column,
                    fmt::format("times must not go back, but {} comes after {}", *time, events_.back().time));
    event.time = *time;
    if (!events_.empty()) event.mouse = events_.back().mouse;
    if (readAction(words, count, event)) events_.push_back(std::move(event));
  }

  bool readAction(const std::array<Word, kMostWords>& words, std::size_t count, InputEvent& event) {
    const std::string_view what = count > 1 ? words[1].text : std::string_view();
    if (what == "mouse" && count == 4) {
      const auto x = number(words[2], "a position in px");
      const auto y = number(words[3], "a position in px");
      if (!x || !y) return false;
      event.mouse = {*x, *y};
      return true;
    }
    const bool key = what == "key";
    const std::string_view way = count > 2 ? words[2].text : std::string_view();
    if ((!key && what != "button") || count != 4 || (way != "down" && way != "up")) {
      reject(words[0].column,
             "an event is 'TIME key down NAME', 'TIME key up NAME', 'TIME button down NAME', 'TIME "
             "button up NAME' or 'TIME mouse X Y'");
      return false;
    }
    event.name = words[3].text;
    if (!key && event.name != "left" && event.name != "middle" && event.name != "right") {
      reject(words[3].column,
             fmt::format("a button is left, middle or right, not {}", quotedText(event.name)));
      return false;
    }
    const bool down = way == "down";
    event.action = key ? (down ? InputAction::KeyDown : InputAction::KeyUp)
                       : (down ? InputAction::ButtonDown : InputAction::ButtonUp);
    return true;
  }

  std::optional<double> number(const Word& word, std::string_view wanted) {
    double value = 0.0;
    const char* end = word.text.data() + word.text.size();
    const auto [stopped, problem] = std::from_chars(word.text.data(), end, value);
    if (problem == std::errc{} && stopped == end && std::isfinite(value)) return value;
    reject(word.column, fmt::format("{} is not {}", quotedText(word.text), wanted));
    return std::nullopt;
  }

  ErrorList errors_;
  std::uint32_t line_ = 0;
  std::vector<InputEvent> events_;
};

} // namespace

InputLog InputLog::read(const std::filesystem::path& file) {
  return parse(readTextFile(file, kLongestLog, "a log of input"), file);
}

InputLog InputLog::parse(std::string_view text, const std::filesystem::path& file) {
  InputLog log;
  log.events_ = LogParser(file).parse(text);
  return log;
}

Vec2 InputLog::mouseAt(double time) const {
  const auto after = std::upper_bound(events_.begin(), events_.end(), time,
                                      [](double when, const InputEvent& event) { return when < event.time; });
  return after == events_.begin() ? Vec2(0.0, 0.0) : std::prev(after)->mouse;
}

std::vector<double> InputLog::presses(InputAction action, std::string_view name) const {
  const InputAction release = action == InputAction::KeyDown ? InputAction::KeyUp : InputAction::ButtonUp;
  std::vector<double> times;
  bool down = false;
  for (const InputEvent& event : events_) {
    if (event.name != name) continue;
    if (event.action == action && !down) times.push_back(event.time);
    if (event.action == action) down = true;
    if (event.action == release) down = false;
  }
  return times;
}

} // namespace offstage
