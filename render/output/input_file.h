#pragma once

#include "render/output/libav.h"

#include <filesystem>
#include <memory>

namespace offstage::libav {

struct CloseInput {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
/// Of a context made with avformat_open_input.
using InputContext = std::unique_ptr<AVFormatContext, CloseInput>;

/// Opens a local file, whatever its name looks like, into `context`; libav's result. `formats`: libavformat's
/// names of the kinds of file that are allowed, with commas; null: all.
int openInput(const std::filesystem::path& file, InputContext& context, const char* formats = nullptr);

} // namespace offstage::libav
