#include "render/output/captions.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::int64_t kMillisecond = 1000000; // ns
constexpr std::string_view kHead = "WEBVTT\n\nNOTE made by Offstage\n";
constexpr std::string_view kNoBreakSpace = "\xc2\xa0";

std::int64_t milliseconds(std::int64_t nanoseconds) {
  return (nanoseconds + kMillisecond / 2) / kMillisecond;
}

std::string timestamp(std::int64_t ms) {
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000);
}

void addCue(std::string& file, std::int64_t start, std::int64_t end, std::string_view text) {
  const std::int64_t from = milliseconds(start);
  const std::int64_t to = milliseconds(end);
  if (from < to) file += fmt::format("\n{} --> {}\n{}\n", timestamp(from), timestamp(to), webVttText(text));
}

/// As much of a text as a 16-bit length can say, in whole characters.
void cutToMovText(std::string& text) {
  std::size_t length = std::numeric_limits<std::uint16_t>::max();
  if (text.size() <= length) return;
  while ((static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) --length; // a character's later bytes
  text.resize(length);
}

} // namespace

std::string webVttText(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool emptyLine = text[i] == '\n' && (i == 0 || text[i - 1] == '\n');
    if (emptyLine) escaped += kNoBreakSpace;
    if (text[i] == '&')
      escaped += "&amp;";
    else if (text[i] == '<')
      escaped += "&lt;";
    else if (text[i] == '>')
      escaped += "&gt;";
    else
      escaped += text[i];
  }
  if (text.ends_with('\n')) escaped += kNoBreakSpace;
  return escaped;
}

std::string webVtt(std::span<const Cue> cues) {
  std::string file(kHead);
  for (const Cue& cue : cues) addCue(file, cue.start, cue.end, cue.text);
  return file;
}

std::string webVtt(std::span<const Chapter> chapters) {
  std::string file(kHead);
  for (const Chapter& chapter : chapters) addCue(file, chapter.start, chapter.end, chapter.title);
  return file;
}

bool isOwnWebVtt(std::string_view bytes) {
  return bytes.starts_with(kHead);
}

std::vector<Cue> withoutOverlaps(std::span<const Cue> cues, std::int64_t end) {
  std::vector<std::int64_t> moments{0, end};
  for (const Cue& cue : cues) {
    moments.push_back(std::clamp<std::int64_t>(cue.start, 0, end));
    moments.push_back(std::clamp<std::int64_t>(cue.end, 0, end));
  }
  std::ranges::sort(moments);
  moments.erase(std::unique(moments.begin(), moments.end()), moments.end());

  std::vector<Cue> row;
  std::vector<const Cue*> shown;
  std::size_t next = 0; // the first cue that has not begun
  for (std::size_t i = 0; i + 1 < moments.size(); ++i) {
    const std::int64_t now = moments[i];
    std::erase_if(shown, [now](const Cue* cue) { return cue->end <= now; });
    for (; next < cues.size() && cues[next].start <= now; ++next)
      if (cues[next].end > now) shown.push_back(&cues[next]);
    std::string text;
    for (const Cue* cue : shown) text += (text.empty() ? "" : "\n") + cue->text;
    cutToMovText(text);
    if (!row.empty() && row.back().text == text)
      row.back().end = moments[i + 1];
    else
      row.push_back({now, moments[i + 1], std::move(text)});
  }
  return row;
}

} // namespace offstage
