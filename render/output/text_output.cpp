#include "render/output/text_output.h"

#include "render/output/file_error.h"

#include <cerrno>
#include <cstdio>

namespace offstage {
TextOutput::TextOutput(const std::filesystem::path& path) : buffer_(nullptr), stream_(nullptr) {
  if (path != "-") {
    file_.emplace(path);
    buffer_ = Buffer(&*file_);
  }
  stream_.rdbuf(&buffer_);
  stream_.exceptions(std::ios::badbit); // lets an Error thrown below reach the caller
}

void TextOutput::commit() {
  stream_.flush();
  if (file_)
    file_->commit();
  else if (std::fflush(stdout) != 0)
    throw standardOutputError(errno);
}

std::streamsize TextOutput::Buffer::xsputn(const char* text, std::streamsize size) {
  const auto bytes = static_cast<std::size_t>(size);
  if (file_ != nullptr)
    file_->write(text, bytes);
  else if (std::fwrite(text, 1, bytes, stdout) != bytes)
    throw standardOutputError(errno);
  return size;
}

TextOutput::Buffer::int_type TextOutput::Buffer::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  const char one = traits_type::to_char_type(character);
  xsputn(&one, 1);
  return character;
}

} // namespace offstage
