#include "render/compare/compare_files.h"
#include "render/compare/frame_stream.h"
#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <array>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

namespace offstage {

InputKind inputKind(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error) || isFramePattern(path)) return InputKind::Sequence;
  if (!std::filesystem::exists(path, error))
    throw Error(ExitCode::BadInput, fmt::format("{} cannot be read: {}", quoted(path),
                                                error ? error.message() : "No such file or directory"));
  // By what the file begins with, whatever it is called. An empty one is a picture that says so.
  std::array<char, 8> begin{};
  std::ifstream in(path, std::ios::binary);
  in.read(begin.data(), begin.size());
  const std::string_view head(begin.data(), static_cast<std::size_t>(in.gcount()));
  const bool picture = head.empty() || head.starts_with("\x89PNG") || head.starts_with("\xFF\xD8\xFF") ||
                       head.starts_with("BM");
  const std::string ending = path.extension().string();
  const bool called = ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".bmp";
  if (ending == ".csv" || ending == ".jsonl") return InputKind::Trace;
  if (ending == ".apng") return InputKind::Video;
  return picture || called ? InputKind::Picture : InputKind::Video;
}

} // namespace offstage
