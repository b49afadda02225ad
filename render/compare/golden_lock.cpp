#include "render/compare/golden_lock.h"

#include "render/output/atomic_file.h"
#include "src/scene/diagnostic.h"
#include "src/scene/quote.h"
#include "src/scene/text_file.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kLargestLock = std::size_t{64} << 20U;
constexpr std::size_t kCells = 8;
constexpr std::string_view kHeader =
    "# golden\tstate\tpixels\tGL renderer\tMesa\tLLVM\tprocessor\tOffstage\n";

/// The word behind `mark` up to a blank or a comma.
std::string wordBehind(std::string_view text, std::string_view mark) {
  const std::size_t found = text.find(mark);
  if (found == std::string_view::npos) return "-";
  const std::string_view rest = text.substr(found + mark.size());
  return std::string(rest.substr(0, rest.find_first_of(" ,)")));
}

std::string processorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "-";
}

/// A name as one cell: no tab, no line break, not empty.
std::string cellOf(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text.empty() ? "-" : text;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t tab = line.find('\t');
    cells.push_back(line.substr(0, tab));
    if (tab == std::string_view::npos) return cells;
    line.remove_prefix(tab + 1);
  }
}

class LockReader {
public:
  explicit LockReader(const std::filesystem::path& file) : file_(file.string()) {}

  void readLine(std::string_view line, std::uint32_t number, std::map<std::string, GoldenEntry>& entries) {
    line_ = number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) return;
    const std::vector<std::string_view> cells = split(line);
    if (cells.size() != kCells)
      fail(1, fmt::format("a golden's line has {} cells separated by tabs, but this one has {}", kCells,
                          cells.size()));
    const std::string name(cells[0]);
    // The name becomes a path, so it must not lead out of the folder.
    if (name.empty() || name.find('/') != std::string::npos)
      fail(1, fmt::format("{} is no golden's name", quotedText(name)));
    GoldenEntry entry;
    entry.state = hash(cells, 1);
    entry.pixels = hash(cells, 2);
    entry.machine = {std::string(cells[3]), std::string(cells[4]), std::string(cells[5]),
                     std::string(cells[6]), std::string(cells[7])};
    if (!entries.emplace(name, std::move(entry)).second)
      fail(1, fmt::format("{} has a line already", quotedText(name)));
  }

private:
  std::uint64_t hash(const std::vector<std::string_view>& cells, std::size_t index) const {
    const std::string_view text = cells[index];
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (error != std::errc{} || end != text.data() + text.size() || text.size() != 16)
      fail(static_cast<std::uint32_t>(text.data() - cells[0].data()) + 1,
           fmt::format("a hash has 16 hexadecimal digits, but here is {}", quotedText(text)));
    return value;
  }

  [[noreturn]] void fail(std::uint32_t column, const std::string& problem) const {
    throw SceneError({{{file_, line_, column}, problem}});
  }

  std::string file_;
  std::uint32_t line_ = 0;
};

} // namespace

GoldenMachine thisMachine(const std::string& renderer, const std::string& glVersion) {
  return {cellOf(renderer), wordBehind(glVersion, "Mesa "), wordBehind(renderer, "LLVM "),
          cellOf(processorName()), OFFSTAGE_VERSION};
}

GoldenLock GoldenLock::load(const std::filesystem::path& file) {
  GoldenLock lock;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return lock;
  const std::string text = readTextFile(file, kLargestLock, "a goldens.lock");
  LockReader reader(file);
  std::string_view rest = text;
  for (std::uint32_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    reader.readLine(line, number, lock.entries_);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return lock;
}

void GoldenLock::save(const std::filesystem::path& file) const {
  AtomicFile out(file);
  out.write(kHeader);
  for (const auto& [name, entry] : entries_) {
    const GoldenMachine& machine = entry.machine;
    out.write(fmt::format("{}\t{:016x}\t{:016x}\t{}\t{}\t{}\t{}\t{}\n", name, entry.state, entry.pixels,
                          machine.renderer, machine.mesa, machine.llvm, machine.processor, machine.version));
  }
  out.commit();
}

const GoldenEntry* GoldenLock::find(const std::string& name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : &found->second;
}

void GoldenLock::set(const std::string& name, const GoldenEntry& entry) {
  const GoldenEntry* old = find(name);
  if (old != nullptr && old->state == entry.state && old->pixels == entry.pixels) return;
  entries_[name] = entry;
}

} // namespace offstage
