#include "tests/support/still_json.h"

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace offstage::test {

/// A recursive-descent reader of RFC 8259's grammar, but for \u escapes.
class JsonReader {
public:
  explicit JsonReader(std::string_view text) : text_(text) {}

  JsonValue document() {
    JsonValue value = any();
    skipSpace();
    if (at_ != text_.size()) fail("nothing more");
    return value;
  }

private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error("JSON at byte " + std::to_string(at_) + ": expected " + expected);
  }
  void skipSpace() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool take(std::string_view token) {
    skipSpace();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  void need(std::string_view token) {
    if (!take(token)) fail(std::string(token));
  }

  JsonValue any() {
    JsonValue value;
    if (take("null")) return value;
    if (take("true")) {
      value.value_ = true;
    } else if (take("false")) {
      value.value_ = false;
    } else if (take("{")) {
      value.value_ = object();
    } else if (take("[")) {
      value.value_ = array();
    } else if (take("\"")) {
      value.value_ = string();
    } else {
      value.value_ = number();
    }
    return value;
  }
  JsonValue::Object object() {
    JsonValue::Object members;
    if (take("}")) return members;
    do {
      need("\"");
      std::string key = string();
      need(":");
      members.emplace_back(std::move(key), any());
    } while (take(","));
    need("}");
    return members;
  }
  JsonValue::Array array() {
    JsonValue::Array values;
    if (take("]")) return values;
    do values.push_back(any());
    while (take(","));
    need("]");
    return values;
  }
  std::string string() {
    std::string result;
    while (at_ < text_.size() && text_[at_] != '"') {
      char c = text_[at_++];
      if (c == '\\') {
        if (at_ == text_.size()) fail("an escaped character");
        c = text_[at_++];
        if (c == 'n') c = '\n';
        if (c == 't') c = '\t';
      }
      result += c;
    }
    if (at_ == text_.size()) fail("'\"'");
    ++at_;
    return result;
  }
  double number() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("a value");
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

JsonValue JsonValue::parse(std::string_view text) {
  return JsonReader(text).document();
}

const JsonValue& JsonValue::operator[](std::string_view key) const {
  static const JsonValue kNull;
  for (const auto& [name, value] : std::get<Object>(value_)) {
    if (name == key) return value;
  }
  return kNull;
}

} // namespace offstage::test
