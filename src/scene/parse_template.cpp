#include "src/scene/parse_template.h"

#include "src/scene/limits.h"
#include "src/scene/probe_name.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <string_view>

#include <fmt/core.h>

namespace offstage {
namespace {

class TemplateReader {
public:
  TemplateReader(SceneBuilder& builder, const TomlValue& value, const std::string& what,
                 std::string_view text)
      : builder_(builder), value_(value), what_(what), text_(text) {}

  std::optional<TextTemplate> read() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool doubled = at_ + 1 < text_.size() && text_[at_ + 1] == c;
      if ((c == '{' || c == '}') && doubled) {
        piece_.text += c;
        at_ += 2;
      } else if (c == '{') {
        readValue();
      } else if (c == '}') {
        report("a '}' without its '{'; a brace itself is written twice");
        ++at_;
      } else {
        piece_.text += c;
        ++at_;
      }
    }
    if (!piece_.text.empty()) result_.pieces.push_back(std::move(piece_));
    if (wrong_) return std::nullopt;
    return std::move(result_);
  }

private:
  void report(const std::string& problem) {
    wrong_ = true;
    const std::string_view before = text_.substr(0, at_);
    const auto character = 1 + std::count_if(before.begin(), before.end(), [](char byte) {
                             return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
                           });
    builder_.errors.add(value_, fmt::format("{}, character {}: {}", what_, character, problem));
  }

  /// `{name}` or `{name:format}` at at_.
  void readValue() {
    const std::size_t end = text_.find('}', at_);
    if (end == std::string_view::npos) {
      report("a '{' without its '}'; a brace itself is written twice");
      at_ = text_.size();
      return;
    }
    const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    const std::size_t colon = inside.find(':');
    try {
      piece_.probe = findProbe(builder_, inside.substr(0, colon)).probe;
    } catch (const ProbeError& error) {
      report(
          fmt::format("{} is no value of the scene: {}", quotedText(inside.substr(0, colon)), error.what()));
    }
    try {
      if (colon != std::string_view::npos) piece_.format = NumberFormat(inside.substr(colon + 1));
    } catch (const NumberFormatError& error) {
      report(fmt::format("{} is no number format: {}", quotedText(inside.substr(colon + 1)), error.what()));
    }
    result_.pieces.push_back(std::move(piece_));
    piece_ = {};
    at_ = end + 1;
  }

  SceneBuilder& builder_;
  const TomlValue& value_;
  const std::string& what_;
  std::string_view text_;
  std::size_t at_ = 0;
  TextTemplate::Piece piece_;
  TextTemplate result_;
  bool wrong_ = false;
};

} // namespace

std::optional<TextTemplate> readTemplate(SceneBuilder& builder, const TomlValue& value,
                                         const std::string& what) {
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) {
    reportMismatch(value, what, "a string", builder.errors);
    return std::nullopt;
  }
  if (text->size() > kMaxTextBytes) {
    builder.errors.add(value, fmt::format("{} may hold at most {} bytes", what, kMaxTextBytes));
    return std::nullopt;
  }
  return TemplateReader(builder, value, what, *text).read();
}

} // namespace offstage
