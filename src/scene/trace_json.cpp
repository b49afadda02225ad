// Traces as JSON lines (RFC 8259, an object a line), the form of `offstage trace -o X.jsonl`.

#include "src/scene/trace_rows.h"

#include <charconv>
#include <optional>
#include <string>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Reads one line: an object whose values are numbers, texts, true, false and null.
class JsonLine {
public:
  explicit JsonLine(std::string_view text) : text_(text) {}

  struct Member {
    std::string key;
    std::string value; ///< a number's digits, a text, "nan" for null
    std::size_t at = 0;
  };

  /// Calls `each` with every member. False when the line is no such object; then at() is where.
  template <class Each>
  bool read(Each each) {
    skipBlanks();
    if (!take('{')) return false;
    skipBlanks();
    if (take('}')) return atEnd();
    do {
      Member member;
      skipBlanks();
      if (!readText(member.key)) return false;
      skipBlanks();
      if (!take(':')) return false;
      skipBlanks();
      member.at = at_;
      if (!readValue(member.value)) return false;
      each(member);
      skipBlanks();
    } while (take(','));
    return take('}') && atEnd();
  }

  [[nodiscard]] std::size_t at() const { return at_; }

private:
  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }
  bool take(char wanted) {
    if (at_ >= text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }
  bool atEnd() {
    skipBlanks();
    return at_ == text_.size();
  }

  bool readValue(std::string& value) {
    if (at_ < text_.size() && text_[at_] == '"') return readText(value);
    const std::size_t end = std::min(text_.find_first_of(",} \t\r", at_), text_.size());
    value = text_.substr(at_, end - at_);
    if (value.empty() || value[0] == '{' || value[0] == '[') return false;
    at_ = end;
    if (value == "null") value = "nan";
    return true;
  }

  bool readText(std::string& text) {
    if (!take('"')) return false;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] != '\\') {
        text += text_[at_++];
      } else if (!readEscape(text)) {
        return false;
      }
    }
    return take('"');
  }

  bool readEscape(std::string& text) {
    constexpr std::string_view kLetters = "\"\\/bfnrt";
    constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
    ++at_;
    if (at_ >= text_.size()) return false;
    const std::size_t which = kLetters.find(text_[at_]);
    if (which != std::string_view::npos) {
      text += kMeanings[which];
      ++at_;
      return true;
    }
    if (text_[at_] != 'u') return false;
    ++at_;
    const auto unit = readHex();
    if (!unit) return false;
    std::uint32_t point = *unit;
    if (point >= 0xd800U && point < 0xdc00U) { // the first of a pair
      if (!take('\\') || !take('u')) return false;
      const auto second = readHex();
      if (!second || *second < 0xdc00U || *second >= 0xe000U) return false;
      point = 0x10000U + ((point - 0xd800U) << 10U) + (*second - 0xdc00U);
    }
    appendUtf8(text, point);
    return true;
  }

  std::optional<std::uint32_t> readHex() {
    if (at_ + 4 > text_.size()) return std::nullopt;
    std::uint32_t value = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, begin + 4, value, 16);
    if (error != std::errc{} || end != begin + 4) return std::nullopt;
    at_ += 4;
    return value;
  }

  static void appendUtf8(std::string& text, std::uint32_t point) {
    const auto continuation = [&](unsigned shift) {
      text += static_cast<char>(0x80U | ((point >> shift) & 0x3fU));
    };
    if (point < 0x80U) {
      text += static_cast<char>(point);
    } else if (point < 0x800U) {
      text += static_cast<char>(0xc0U | (point >> 6U));
      continuation(0);
    } else if (point < 0x10000U) {
      text += static_cast<char>(0xe0U | (point >> 12U));
      continuation(6);
      continuation(0);
    } else {
      text += static_cast<char>(0xf0U | (point >> 18U));
      continuation(12);
      continuation(6);
      continuation(0);
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// One bit a column.
unsigned bit(TraceColumn column) {
  return 1U << static_cast<unsigned>(column);
}

constexpr unsigned kRequired = (1U << kRequiredTraceColumns) - 1U;

} // namespace

Trace parseJsonTrace(std::string_view text, const std::filesystem::path& file) {
  TraceRows rows(file);
  ErrorList& errors = rows.errors();
  std::optional<bool> hasVelocity;
  for (std::uint32_t number = 1; !text.empty() && !errors.full(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;

    TraceRow row;
    row.line = number;
    unsigned found = 0;
    JsonLine json(line);
    const bool good = json.read([&](const JsonLine::Member& member) {
      const TraceColumn column = traceColumn(member.key);
      const auto place = static_cast<std::uint32_t>(member.at) + 1;
      if (column != TraceColumn::Other && (found & bit(column)) != 0)
        errors.add(number, place, fmt::format("'{}' is there twice", name(column)));
      found |= bit(column);
      rows.read(column, {member.value, number, place, false}, row);
    });
    if (!good) {
      errors.add(number, static_cast<std::uint32_t>(json.at()) + 1,
                 "here this line stops being a JSON object of numbers and texts");
      continue;
    }
    for (std::size_t i = 0; i < kRequiredTraceColumns; ++i) {
      const auto column = static_cast<TraceColumn>(i);
      if ((found & bit(column)) == 0)
        errors.add(number, 1, fmt::format("this line has no '{}'", name(column)));
    }
    const unsigned velocity = found & (bit(TraceColumn::Vx) | bit(TraceColumn::Vy));
    const bool whole = velocity == (bit(TraceColumn::Vx) | bit(TraceColumn::Vy));
    if (hasVelocity.value_or(whole) != whole || (velocity != 0 && !whole))
      errors.add(number, 1, "all lines of a trace have both 'vx' and 'vy', or none has");
    hasVelocity = hasVelocity.value_or(whole);
    if ((found & kRequired) == kRequired) rows.add(row);
  }
  return rows.finish(hasVelocity.value_or(false));
}

} // namespace offstage
