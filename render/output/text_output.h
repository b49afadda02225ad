#pragma once

#include "render/output/atomic_file.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <streambuf>

namespace offstage {

/// A text output as a std::ostream: a file that appears whole or not at all, or standard output for "-".
/// Writing throws Error as AtomicFile does (a closed pipe is Error(Transient)).
class TextOutput {
public:
  explicit TextOutput(const std::filesystem::path& path);

  [[nodiscard]] std::ostream& stream() { return stream_; }
  void commit(); ///< flushes, and puts the file under its name

private:
  class Buffer : public std::streambuf {
  public:
    explicit Buffer(AtomicFile* file) : file_(file) {}

  private:
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int_type overflow(int_type character) override;
    AtomicFile* file_; ///< null: standard output
  };

  std::optional<AtomicFile> file_;
  Buffer buffer_;
  std::ostream stream_;
};

} // namespace offstage
