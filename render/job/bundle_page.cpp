#include "render/job/bundle_page.h"

#include "render/output/json_text.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

/// A JSON string that may stand in a script: "</script>" would end it.
std::string scriptText(std::string_view text) {
  std::string safe;
  for (const char c : jsonText(std::string(text))) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

template <class Items, class TextOf>
std::string cueList(const Items& items, TextOf textOf) {
  std::string list;
  for (const auto& item : items)
    list +=
        fmt::format("{}[{:.3f},{:.3f},{}]", list.empty() ? "" : ",", static_cast<double>(item.start) * 1e-9,
                    static_cast<double>(item.end) * 1e-9, scriptText(textOf(item)));
  return '[' + list + ']';
}

/// A file's name as a relative address: percent-encoded but for letters, digits and . _ - (RFC 3986, 2.3).
std::string addressOf(std::string_view name) {
  std::string address;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '_' || c == '-';
    if (plain)
      address += c;
    else
      address += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return address;
}

} // namespace

std::string htmlText(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string bundlePage(const BundleContents& contents) {
  std::string links;
  for (const std::string& file : contents.files)
    links += fmt::format("<a href=\"{}\" download>{}</a>", addressOf(file), htmlText(file));
  const std::vector<std::pair<std::string_view, std::string>> values{
      {"title", htmlText(contents.title)},
      {"width", fmt::format("{}", contents.width)},
      {"height", fmt::format("{}", contents.height)},
      {"poster", addressOf(contents.poster)},
      {"mp4", addressOf(contents.mp4)},
      {"webm", addressOf(contents.webm)},
      {"links", links},
      {"tracks",
       fmt::format("{{\"captions\":{},\"chapters\":{}}}",
                   cueList(contents.captions, [](const Cue& cue) { return cue.text; }),
                   cueList(contents.chapters, [](const Chapter& chapter) { return chapter.title; }))}};
  std::string page;
  for (std::size_t at = 0; at < kBundlePage.size();) {
    const std::size_t open = kBundlePage.find("{{", at);
    page += kBundlePage.substr(at, open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = kBundlePage.find("}}", open);
    const std::string_view name = kBundlePage.substr(open + 2, close - open - 2);
    bool known = false;
    for (const auto& [key, value] : values) {
      if (key != name) continue;
      page += value;
      known = true;
    }
    if (!known) throw std::logic_error("the page has a place for " + std::string(name));
    at = close + 2;
  }
  return page;
}

} // namespace offstage
