#include "render/compare/frame_stream.h"

#include "render/output/file_error.h"
#include "render/output/frame_pattern.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Pictures by what pairs them.
struct Listing {
  std::vector<std::pair<std::string, std::filesystem::path>> files; ///< key, file; in order
};

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// frame9 before frame10: runs of digits are compared as numbers.
bool naturallyBefore(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (isDigit(a.front()) && isDigit(b.front())) {
      const auto number = [](std::string_view& text) {
        while (text.size() > 1 && text[0] == '0' && isDigit(text[1])) text.remove_prefix(1);
        const auto end = std::ranges::find_if_not(text, isDigit) - text.begin();
        const std::string_view digits = text.substr(0, static_cast<std::size_t>(end));
        text.remove_prefix(digits.size());
        return digits;
      };
      const std::string_view x = number(a);
      const std::string_view y = number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() < b.size();
}

/// A total order of names: numbers by value first, then every character.
bool precedes(const std::string& a, const std::string& b) {
  if (naturallyBefore(a, b) != naturallyBefore(b, a)) return naturallyBefore(a, b);
  return a < b;
}

bool isPictureName(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".bmp";
}

[[noreturn]] void failToList(const std::filesystem::path& folder, const std::error_code& error) {
  throw Error(ExitCode::BadInput, fmt::format("{} cannot be read: {}", quoted(folder), error.message()));
}

template <class F>
void forEachFile(const std::filesystem::path& folder, F f) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) failToList(folder, error);
  for (; entries != std::filesystem::directory_iterator(); entries.increment(error)) {
    if (entries->is_regular_file(error)) f(entries->path());
  }
  if (error) failToList(folder, error);
}

Listing listFolder(const std::filesystem::path& folder) {
  Listing listing;
  forEachFile(folder, [&](const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    if (isPictureName(file) && !name.starts_with('.')) listing.files.emplace_back(name, file);
  });
  std::ranges::sort(listing.files, [](const auto& x, const auto& y) { return precedes(x.first, y.first); });
  if (listing.files.empty())
    throw Error(ExitCode::BadInput,
                fmt::format("{} holds no pictures (.png, .jpg, .jpeg, .bmp)", quoted(folder)));
  return listing;
}

Listing listPattern(const std::filesystem::path& path) {
  const FramePattern pattern(path);
  std::map<std::int64_t, std::filesystem::path> files;
  forEachFile(pattern.folder(), [&](const std::filesystem::path& file) {
    if (const auto number = pattern.numberOf(file.filename().string())) files.emplace(*number, file);
  });
  if (files.empty()) throw Error(ExitCode::BadInput, fmt::format("there is no picture {}", quoted(path)));
  Listing listing;
  for (const auto& [number, file] : files) listing.files.emplace_back(fmt::format("{}", number), file);
  return listing;
}

class FileStream final : public FrameStream {
public:
  FileStream(std::vector<StreamFrame> frames, std::optional<double> fps) : frames_(std::move(frames)) {
    for (std::size_t i = 0; i < frames_.size() && fps; ++i) frames_[i].time = static_cast<double>(i) / *fps;
  }
  std::optional<StreamFrame> next() override {
    if (at_ == frames_.size()) return std::nullopt;
    return frames_[at_++];
  }

private:
  std::vector<StreamFrame> frames_;
  std::size_t at_ = 0;
};

class VideoStream final : public FrameStream {
public:
  VideoStream(const std::filesystem::path& file, std::int64_t maxPixels, int threads)
      : reader_(file, maxPixels, threads) {}
  std::optional<StreamFrame> next() override {
    StreamFrame frame;
    frame.video = reader_.next();
    if (!frame.video) return std::nullopt;
    frame.time = frame.video->time;
    return frame;
  }

private:
  VideoReader reader_;
};

StreamFrame frameOf(const std::filesystem::path& file) {
  return {file.filename().string(), std::nullopt, file, nullptr};
}

StreamFrame absentFrame(const std::string& name) {
  return {name, std::nullopt, {}, nullptr};
}

using ByKey = std::map<std::string, std::filesystem::path>;

ByKey byKey(const Listing& listing) {
  return {listing.files.begin(), listing.files.end()};
}

bool shareAKey(const ByKey& a, const ByKey& b) {
  return std::ranges::any_of(a, [&](const auto& one) { return b.contains(one.first); });
}

/// Both lists of the same length: what one of them lacks is absent there.
std::pair<std::vector<StreamFrame>, std::vector<StreamFrame>> pairByKey(const ByKey& a, const ByKey& b) {
  std::vector<std::string> keys;
  for (const auto& [key, file] : a) keys.push_back(key);
  for (const auto& [key, file] : b)
    if (!a.contains(key)) keys.push_back(key);
  std::ranges::sort(keys, precedes);
  std::pair<std::vector<StreamFrame>, std::vector<StreamFrame>> pairs;
  for (const std::string& key : keys) {
    const auto inA = a.find(key);
    const auto inB = b.find(key);
    const std::string name = (inA != a.end() ? inA : inB)->second.filename().string();
    pairs.first.push_back(inA != a.end() ? frameOf(inA->second) : absentFrame(name));
    pairs.second.push_back(inB != b.end() ? frameOf(inB->second) : absentFrame(name));
  }
  return pairs;
}

std::vector<StreamFrame> inOrder(const Listing& listing) {
  std::vector<StreamFrame> frames;
  for (const auto& [key, file] : listing.files) frames.push_back(frameOf(file));
  return frames;
}

std::optional<Listing> listFiles(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return listFolder(path);
  if (isFramePattern(path)) return listPattern(path);
  return std::nullopt;
}

} // namespace

bool isFramePattern(const std::filesystem::path& path) {
  std::error_code error;
  return path.filename().string().find('%') != std::string::npos && !std::filesystem::exists(path, error);
}

std::pair<std::unique_ptr<FrameStream>, std::unique_ptr<FrameStream>>
openStreams(const std::filesystem::path& expected, const std::filesystem::path& actual,
            std::int64_t maxPixels, std::optional<double> fps, int threads) {
  const std::optional<Listing> a = listFiles(expected);
  const std::optional<Listing> b = listFiles(actual);
  const auto files = [&](std::vector<StreamFrame> frames) {
    return std::make_unique<FileStream>(std::move(frames), fps);
  };
  if (a && b) {
    const ByKey inA = byKey(*a);
    const ByKey inB = byKey(*b);
    if (shareAKey(inA, inB)) {
      auto [first, second] = pairByKey(inA, inB);
      return {files(std::move(first)), files(std::move(second))};
    }
    return {files(inOrder(*a)), files(inOrder(*b))};
  }
  const auto open = [&](const std::optional<Listing>& listing,
                        const std::filesystem::path& path) -> std::unique_ptr<FrameStream> {
    if (listing) return files(inOrder(*listing));
    return std::make_unique<VideoStream>(path, maxPixels, threads);
  };
  return {open(a, expected), open(b, actual)};
}

} // namespace offstage
