#include "render/output/libav.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace offstage::libav {

IoContext makeOutput(int bufferSize, void* self, int (*write)(void*, std::uint8_t*, int),
                     std::int64_t (*seek)(void*, std::int64_t, int)) {
  auto* buffer = static_cast<unsigned char*>(allocated(av_malloc(static_cast<std::size_t>(bufferSize))));
  AVIOContext* context = avio_alloc_context(buffer, bufferSize, 1, self, nullptr, write, seek);
  if (context == nullptr) av_free(buffer);
  return IoContext(allocated(context));
}

void Options::set(const char* key, const std::string& value) {
  if (av_dict_set(&entries_, key, value.c_str(), 0) < 0) throw std::bad_alloc();
}

void Options::requireAllTaken() const {
  const AVDictionaryEntry* left = av_dict_get(entries_, "", nullptr, AV_DICT_IGNORE_SUFFIX);
  if (left != nullptr)
    throw std::logic_error(fmt::format("libav does not know the option {}={}", left->key, left->value));
}

std::string errorText(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

int check(int result, ExitCode code, std::string_view what) {
  if (result >= 0) return result;
  if (result == AVERROR(ENOMEM)) throw std::bad_alloc();
  throw Error(code, fmt::format("{}: {}", what, errorText(result)));
}

void quietLog(int level) {
  if (av_log_get_level() > level) av_log_set_level(level);
}

} // namespace offstage::libav
