#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace offstage::test {

/// A JSON value, as far as the oracle's stills need it: escapes in strings are limited to \" \\ \/ \n \t.
class JsonValue {
public:
  using Array = std::vector<JsonValue>;
  using Object = std::vector<std::pair<std::string, JsonValue>>;

  /// Throws std::runtime_error with the offset of what is not JSON.
  static JsonValue parse(std::string_view text);

  [[nodiscard]] bool isNull() const { return std::holds_alternative<std::nullptr_t>(value_); }
  [[nodiscard]] double number() const { return std::get<double>(value_); }
  [[nodiscard]] bool boolean() const { return std::get<bool>(value_); }
  [[nodiscard]] const std::string& text() const { return std::get<std::string>(value_); }
  [[nodiscard]] const Array& array() const { return std::get<Array>(value_); }

  /// A member of an object; null (a value that isNull()) when it has none of that name.
  [[nodiscard]] const JsonValue& operator[](std::string_view key) const;

private:
  friend class JsonReader;
  std::variant<std::nullptr_t, bool, double, std::string, Array, Object> value_ = nullptr;
};

} // namespace offstage::test
