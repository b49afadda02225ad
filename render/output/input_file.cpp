#include "render/output/input_file.h"

namespace offstage::libav {

int openInput(const std::filesystem::path& file, InputContext& context, const char* formats) {
  quietLog(AV_LOG_FATAL);
  const std::string url = "file:" + file.native(); // "file:" keeps a:b.mp4 from being taken for a protocol
  Options options;
  if (formats != nullptr) options.set("format_whitelist", formats);
  AVFormatContext* opened = nullptr;
  const int result = avformat_open_input(&opened, url.c_str(), nullptr, options.get());
  context.reset(opened);
  return result;
}

} // namespace offstage::libav
