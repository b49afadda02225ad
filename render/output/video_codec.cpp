#include "render/output/video_codec.h"

#include "render/output/file_error.h"
#include "render/output/output_kind.h"

#include <stdexcept>

#include <fmt/format.h>

namespace offstage {
namespace {

// H.264, chosen on workload R of the bench (N moving opaque circles, 1920 × 1080, white; x264 0.164, one
// thread). CPU ms a frame, bytes a frame, SSIM against the frames before encoding:
//                      N = 10              N = 1000              N = 10000
//   veryfast, crf 20   15.6   824 .99954   52.7  33718 .98594    98.6 217265 .94669
//   A                  12.4  1082 .99963   38.6  44954 .98926    72.6 270263 .96148
//   B                  10.9   843 .99954   31.2  35869 .98656    67.7 223446 .94890
//   C                  10.6   759 .99948   32.9  35009 .98557    64.1 235208 .95150
//   C, spatial         10.8   940 .99951   36.3  39077 .98603    66.6 242091 .95263
//   C, fast-pskip=0    15.1   913 .99949   36.6  35321 .98577    75.9 235219 .95150
//   C, dct-decimate=0  11.0   818 .99955   29.1  36201 .98647    67.4 234283 .95193
//   superfast           8.3  1575 .99976   22.8  44525 .98261    50.3 190661 .91541
// and with chroma sited left, as here, in the frames before encoding:
//   veryfast, crf 20   13.4   822 .99960   50.5  34811 .98728    92.3 212456 .94798
//   D                  9.0   813 .99961   26.8  36659 .98753    62.5 218190 .95066
// and of the first 60 frames (N = 10000: 30), the sum of CPU seconds, KiB, SSIM:
//   veryfast, crf 20   0.76    52 .99961    2.80   1942 .98678    2.53   6024 .94704
//   D                  0.58    53 .99962    1.71   2053 .98722    1.97   6345 .95039
//   E                  0.50    52 .99962    1.50   2084 .98707    1.70   6400 .95040
// and of 60 frames at all three, and of an image on 100 circles (P), KiB, SSIM; their CPU seconds are the
// same within what the machine varies:
//                            N = 10       N = 1000       N = 10000        P
//   veryfast, crf 20         52 .99961    1942 .98678    12010 .94665    947 .99155
//   E                        52 .99962    2087 .98706    12753 .95002    913 .99184
//   E, no 8x8dct, crf 18.7   48 .99959    1934 .98679    11979 .95056     -     -
//   F                        51 .99961    2056 .98762    12699 .95421    904 .99176
//   F, qcomp=0.4, crf 16.6   52 .99962    2041 .98764    12247 .95192    885 .99188*   * crf 16.7
//   G                        52 .99962    2018 .98746    11676 .94861    889 .99217
//   F, qcomp=0.2, crf 13.8   53 .99963    2004 .98725    11198 .94546    886 .99228
//   H                        53 .99961    2099 .98713    11512 .94707    908 .99199
// Weights of P-frames, for fades: CPU seconds (medians of four in turns, ffmpeg on ready frames), KiB and
// SSIM of 60 frames (N = 10000: 30), of the first second of scenes/fade.toml at twice its size, and of the
// first two of lecture_collision.toml, which fades in:
//                              H             weightp=1          weightp=2       veryfast, crf 20
//   N = 10             0.54   53 .99961   0.54   53 .99961   0.54   53 .99961
//   N = 1000           1.34 2099 .98713   1.33 2099 .98713   1.33 2099 .98713
//   N = 10000          1.51 5804 .94727   1.49 5804 .94727   1.47 5804 .94727
//   fade               0.53   88 .99982   0.52   63 .99974   0.52   63 .99974        45 .99974
//   lecture_collision  0.47  121 .99890   0.47   45 .99748   0.47   45 .99748        30 .99800
// A whole render with H, one worker, takes 9.4 s of CPU at N = 1000 (300 frames) and 5.0 s at
// 10000 (60), with G 9.7 s and 5.3 s: medians of three.
//
// A: subme=1 b-adapt=0, crf 18. B: A with rc-lookahead=20 bframes=4 weightp=0 direct=temporal, crf 20. C:
// B with rc-lookahead=5 bframes=2 b-pyramid=none qcomp=0.65, crf 20.2. D: C with dct-decimate=0 qcomp=0.5,
// crf 18. E: D with me=dia merange=8. F: E without 8x8 intra blocks, whose prediction blurs small circles
// (without any 8x8 transform the profile would be Main), crf 18.1. G: F with qcomp=0.3, crf 15.2. H: G with
// P macroblocks whole, qcomp=0.25, crf 14.6. The one below: H with weightp=1 and without looking for scene
// cuts, which takes 6 % of the time at N = 1000: a chunk begins with a key frame anyway, and a macroblock
// that nothing predicts is coded for itself all the same. Where bodies move on, the temporal prediction of
// B-frames is exact. x264 drops blocks that have few small coefficients (decimation); in flat graphics those
// are the edges. A low qcomp spends less where much moves. Every frame of lookahead takes 6 MB at this size
// and the pyramid 30 MB, so B takes 330 MB a worker and this one 200. Psychovisual optimisation does nothing
// below subme 6. cpu-independent: else x264 chooses some algorithms by the processor, and the bytes with
// them.
constexpr const char* kX264Fast =
    "subme=1:b-adapt=0:bframes=2:b-pyramid=none:weightp=1:direct=temporal:"
    "dct-decimate=0:rc-lookahead=5:scenecut=0:qcomp=0.25:me=dia:merange=8:partitions=b8x8,i4x4:"
    "cpu-independent=1";

// The other qualities, on the first 2 s of scenes at twice their size (one worker, CPU seconds of the whole
// render, the lesser of two runs; KiB; SSIM). draft and high as they were had the settings of good without
// macroblock tree at crf 28, which made larger files than good, and the preset medium as it is at crf 14.
//                          draft                good                 high               high before
//   exercise2_bounce   0.57  17 .99992      0.82  17 .99996      1.09  22 .99999      1.23  21 .99999
//   spawn              0.51  10 .99988      0.73  10 .99997      0.96  10 .99999      1.16  11 1.0000
//   trails             0.83  63 .99795      1.07  92 .99929      1.40 124 .99977      2.28 127 .99980
//   plots              1.30 117 .99654      1.46 146 .99929      2.47 185 .99975      3.22 201 .99984
//   shapes             0.52  78 .98680      0.45  92 .99575      0.86 124 .99793      1.30 154 .99846
//   pile               1.14 357 .98857      1.68 593 .99691      3.03 870 .99919      4.43 721 .99926
//   lecture_collision  3.07 123 .99736      4.13 306 .99930      5.26 166 .99957      6.97 143 .99979
// lecture_collision fades in at first, and good had no weights then. draft looks at nothing ahead and no
// further than whole pixels; high has 5 frames of lookahead instead of 40, 2 references instead of 3 and no
// pyramid, so that a worker takes 130 MB at 1920 × 1080 instead of 425.
constexpr const char* kX264Draft =
    "subme=0:b-adapt=0:bframes=2:b-pyramid=none:weightp=0:direct=temporal:dct-decimate=0:rc-lookahead=0:"
    "scenecut=0:qcomp=0.25:me=dia:merange=8:partitions=b8x8,i4x4:cpu-independent=1";
constexpr const char* kX264High =
    "b-adapt=0:bframes=2:b-pyramid=none:ref=2:dct-decimate=0:rc-lookahead=5:cpu-independent=1";

const std::vector<CodecTraits> kCodecs{
    {VideoCodec::H264, "libx264", ".mp4 .mkv .mov", "libavcodec59", "H.264", false, true, 1, 16384, "h264",
     "High", AV_PIX_FMT_YUV420P, AV_PIX_FMT_NONE, AV_PIX_FMT_YUV420P},
    {VideoCodec::H264Rgb, "libx264rgb", "lossless .mkv", "libavcodec59", "lossless H.264", true, false, 1,
     16384, "h264", "High 4:4:4 Predictive", AV_PIX_FMT_BGR0, AV_PIX_FMT_NONE, AV_PIX_FMT_GBRP},
    {VideoCodec::Vp9, "libvpx-vp9", ".webm", "libavcodec59", "VP9", false, true, 1, 16384, "vp9", "Profile 0",
     AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUVA420P, AV_PIX_FMT_YUV420P},
    {VideoCodec::ProRes, "prores_ks", "transparent .mov", "libavcodec59", "ProRes 4444", false, false, 1,
     16384, "prores", "4444", AV_PIX_FMT_NONE, AV_PIX_FMT_YUVA444P10, AV_PIX_FMT_YUVA444P12},
    {VideoCodec::Ffv1, "ffv1", "transparent lossless .mkv", "libavcodec59", "FFV1", true, false, 3, 16384,
     "ffv1", nullptr, AV_PIX_FMT_NONE, AV_PIX_FMT_BGRA, AV_PIX_FMT_BGRA},
};

[[noreturn]] void refuseLossless(const std::filesystem::path& out, const char* ending) {
  throw Error(
      ExitCode::BadInput,
      fmt::format("{}: a {} has no lossless quality; use .mkv with --quality lossless, .apng, a PNG sequence "
                  "(frames/%06d.png) or .raw",
                  quoted(out), ending));
}

using OptionList = std::vector<std::pair<std::string, std::string>>;

OptionList h264Options(Quality quality) {
  switch (quality) {
  case Quality::Draft:
    return {{"preset", "superfast"}, {"profile", "high"}, {"crf", "34"}, {"x264-params", kX264Draft}};
  case Quality::Good:
    return {{"preset", "veryfast"}, {"profile", "high"}, {"crf", "14.6"}, {"x264-params", kX264Fast}};
  case Quality::High:
    return {{"preset", "medium"}, {"profile", "high"}, {"crf", "13"}, {"x264-params", kX264High}};
  case Quality::Lossless:
    break;
  }
  throw std::logic_error("H.264 in yuv420p is not lossless");
}

OptionList vp9Options(Quality quality) {
  // Constant quality (crf with b=0). Threads and tiles would change the bytes with the machine. In one pass
  // the encoder makes nothing of frames ahead: with 16 of them SSIM and size were the same in all digits
  // shown (.999477, 484 KB for a second of bouncing balls; .999668, 94 KB for two of plots), and 74 MB more
  // were taken at 1920 × 1080. Its alternate reference frames need them, and do not go with transparency.
  // What it takes of memory beyond that no setting changes; src/app/memset.cpp keeps most of it from being
  // taken.
  OptionList options{{"b", "0"},         {"row-mt", "0"},        {"tile-columns", "0"},
                     {"tile-rows", "0"}, {"lag-in-frames", "0"}, {"auto-alt-ref", "0"}};
  const auto set = [&options](const char* deadline, const char* speed, const char* crf) {
    options.insert(options.end(), {{"deadline", deadline}, {"cpu-used", speed}, {"crf", crf}});
  };
  if (quality == Quality::Draft)
    set("realtime", "8", "40");
  else if (quality == Quality::Good)
    set("good", "5", "30");
  else
    set("good", "3", "20");
  return options;
}

} // namespace

const std::vector<CodecTraits>& allCodecs() {
  return kCodecs;
}

const CodecTraits& traitsOf(VideoCodec codec) {
  return kCodecs.at(static_cast<std::size_t>(codec));
}

VideoCodec chooseCodec(const std::filesystem::path& out, Container container, bool alpha, Quality quality) {
  const bool lossless = quality == Quality::Lossless;
  switch (container) {
  case Container::Mp4:
    if (alpha) refuseTransparency(out, "H.264 in .mp4");
    if (lossless) refuseLossless(out, ".mp4");
    return VideoCodec::H264;
  case Container::Mov:
    if (lossless) refuseLossless(out, ".mov");
    return alpha ? VideoCodec::ProRes : VideoCodec::H264;
  case Container::WebM:
    if (lossless) refuseLossless(out, ".webm");
    return VideoCodec::Vp9;
  case Container::Matroska:
    if (lossless) return alpha ? VideoCodec::Ffv1 : VideoCodec::H264Rgb;
    if (alpha) refuseTransparency(out, "H.264 in .mkv");
    return VideoCodec::H264;
  }
  throw std::logic_error("unknown container");
}

OptionList optionsOf(VideoCodec codec, Quality quality) {
  switch (codec) {
  case VideoCodec::H264:
    return h264Options(quality);
  case VideoCodec::H264Rgb:
    return {
        {"preset", "veryfast"}, {"qp", "0"}, {"x264-params", "b-adapt=0:rc-lookahead=10:cpu-independent=1"}};
  case VideoCodec::Vp9:
    return vp9Options(quality);
  case VideoCodec::ProRes:
    return {{"profile", "4444"},
            {"vendor", "apl0"}, // what editing programs ask for before they read the alpha plane
            {"alpha_bits", "16"},
            {"global_quality", std::to_string(FF_QP2LAMBDA * (quality == Quality::Draft  ? 12
                                                              : quality == Quality::Good ? 4
                                                                                         : 1))}};
  case VideoCodec::Ffv1:
    return {{"level", "3"}, {"slicecrc", "1"}, {"slices", "4"}, {"g", "1"}};
  }
  throw std::logic_error("unknown codec");
}

} // namespace offstage
