#include "render/output/json_text.h"

#include "src/scene/utf8.h"

#include <fmt/format.h>

namespace offstage {

std::string jsonText(std::string_view text) {
  std::string json = "\"";
  for (const char c : repairedUtf8(text)) {
    if (c == '"' || c == '\\')
      json += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      json += c;
  }
  return json + '"';
}

} // namespace offstage
