#pragma once

#include <filesystem>
#include <string_view>

namespace offstage {

/// The greatest height of a picture of this width that FFmpeg's libraries code and decode, in px: 8 (width +
/// 128)(height + 128) stays below 2^31 − 1 (av_image_check_size2 in libavutil/imgutils.c). At 16384 px it is
/// 16128. x264 itself takes 16384 px a side, libvpx 65535, ProRes and GIF have 16 bits for a side, FFV1 and
/// PNG 32.
int mostCodedHeight(int width);

/// Throws Error(BadInput), with the limit and what to use instead, when a side is longer than `mostSide` px,
/// or the picture larger than FFmpeg's libraries can code, or read again for the check of the finished file.
/// `what` names the format in the message.
void requireCodedSize(const std::filesystem::path& out, std::string_view what, int mostSide, int width,
                      int height);

} // namespace offstage
