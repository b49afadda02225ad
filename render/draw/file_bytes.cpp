#include "render/draw/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

namespace offstage {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

} // namespace

std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& file, std::size_t limit) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw std::runtime_error("is a folder");
  const std::unique_ptr<std::FILE, CloseFile> in(std::fopen(file.c_str(), "rb"));
  if (in == nullptr) throw std::runtime_error(std::strerror(errno));
  std::setvbuf(in.get(), nullptr, _IONBF, 0);

  std::vector<std::uint8_t> bytes;
  // The size is only a hint: a device or pipe tells none, and a file may grow.
  const std::uintmax_t hint = std::filesystem::file_size(file, error);
  constexpr std::size_t kChunk = 1UL << 16;
  std::size_t room = error || hint > limit ? kChunk : static_cast<std::size_t>(hint) + 1;
  for (bool more = true; more && bytes.size() <= limit; room = kChunk + bytes.size()) {
    const std::size_t size = bytes.size();
    bytes.resize(size + room);
    const std::size_t got = std::fread(bytes.data() + size, 1, room, in.get());
    bytes.resize(size + got);
    more = got == room;
  }
  if (std::ferror(in.get()) != 0) throw std::runtime_error(std::strerror(errno));
  if (bytes.size() > limit) throw std::runtime_error(fmt::format("is larger than {} bytes", limit));
  if (bytes.empty()) throw std::runtime_error("is empty");
  return bytes;
}

} // namespace offstage
