#include "render/output/verify_tracks.h"

#include "render/output/captions.h"
#include "render/output/file_error.h"
#include "render/output/input_file.h"
#include "render/output/side_streams.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr AVRational kNanosecond{1, 1000000000};
constexpr std::int64_t kMillisecond = 1000000; ///< ns
/// The longest packet of either sound codec is 21.3 ms; the containers round to milliseconds.
constexpr std::int64_t kSoundTolerance = 25 * kMillisecond;

class TracksVerifier {
public:
  TracksVerifier(const std::filesystem::path& file, Container container, const VideoTracks& expected,
                 const std::filesystem::path& name)
      : expected_(expected), isMov_(container == Container::Mp4 || container == Container::Mov), name_(name) {
    check(libav::openInput(file, format_), "it cannot be opened again");
    check(avformat_find_stream_info(format_.get(), nullptr), "its streams are not recognised");
    soundName_ = traitsOf(soundCodecOf(container)).decoded;
  }

  void run() {
    findStreams();
    readAll();
    compareChapters();
    compareCaptions();
    compareSound();
    if (differences_.empty()) return;
    throw Error(ExitCode::Transient,
                fmt::format("the check of the finished {} failed: {}", quoted(name_), differences_));
  }

private:
  void check(int result, std::string_view what) const {
    libav::check(result, ExitCode::Transient,
                 fmt::format("the check of the finished {} failed: {}", quoted(name_), what));
  }

  template <class Found, class Wanted>
  void compare(std::string_view what, const Found& found, const Wanted& wanted) {
    if (found == wanted) return;
    if (!differences_.empty()) differences_ += "; ";
    differences_ += fmt::format("{} {} instead of {}", what, found, wanted);
  }

  void compareTime(const std::string& what, std::int64_t found, std::int64_t wanted, std::int64_t tolerance) {
    if (std::abs(found - wanted) > tolerance)
      compare(what, fmt::format("{:.6f} s", static_cast<double>(found) * 1e-9),
              fmt::format("{:.6f} s", static_cast<double>(wanted) * 1e-9));
  }

  void findStreams() {
    int sounds = 0;
    int captions = 0;
    for (unsigned i = 0; i < format_->nb_streams; ++i) {
      const AVStream& stream = *format_->streams[i];
      if (stream.codecpar->codec_type == AVMEDIA_TYPE_AUDIO) {
        sound_ = &stream;
        ++sounds;
      } else if (stream.codecpar->codec_type == AVMEDIA_TYPE_SUBTITLE) {
        captions_ = &stream;
        ++captions;
      }
    }
    compare("number of sound streams", sounds, expected_.sound ? 1 : 0);
    compare("number of caption streams", captions, expected_.captions.empty() ? 0 : 1);
  }

  void readAll() {
    const libav::Packet packet = libav::makePacket();
    while (true) {
      const int result = av_read_frame(format_.get(), packet.get());
      if (result == AVERROR_EOF) break;
      check(result, "it cannot be read to the end");
      const AVStream* stream = format_->streams[packet->stream_index];
      const std::int64_t start = av_rescale_q(packet->pts, stream->time_base, kNanosecond);
      const std::int64_t end = av_rescale_q(packet->pts + packet->duration, stream->time_base, kNanosecond);
      if (stream == sound_) soundEnd_ = std::max(soundEnd_, end);
      if (stream == captions_) addCue(start, end, *packet);
      av_packet_unref(packet.get());
    }
  }

  void addCue(std::int64_t start, std::int64_t end, const AVPacket& packet) {
    std::string_view text(reinterpret_cast<const char*>(packet.data), static_cast<std::size_t>(packet.size));
    if (isMov_) { // the length in two bytes; the demuxer may have put style boxes behind the text
      if (text.size() < 2) return;
      const std::size_t length = static_cast<std::size_t>(static_cast<unsigned char>(text[0])) << 8U |
                                 static_cast<unsigned char>(text[1]);
      text = text.substr(2, length);
      if (text.empty()) return; // nothing is shown
    }
    found_.push_back({start, end, std::string(text)});
  }

  void compareChapters() {
    compare("number of chapters", std::size_t{format_->nb_chapters}, expected_.chapters.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(format_->nb_chapters, expected_.chapters.size()); ++i) {
      const AVChapter& found = *format_->chapters[i];
      const Chapter& wanted = expected_.chapters[i];
      const AVDictionaryEntry* title = av_dict_get(found.metadata, "title", nullptr, 0);
      compare(fmt::format("title of chapter {}", i + 1),
              std::string_view(title == nullptr ? "" : title->value), std::string_view(wanted.title));
      compareTime(fmt::format("start of chapter {}", i + 1),
                  av_rescale_q(found.start, found.time_base, kNanosecond), wanted.start, 2 * kMillisecond);
    }
  }

  /// What the stream holds: times in whole milliseconds, and nothing that none is left of.
  [[nodiscard]] std::vector<Cue> wantedCues() const {
    const auto rounded = [this](std::int64_t time) {
      return av_rescale_q(std::min(time, expected_.end), kNanosecond, {1, 1000}) * kMillisecond;
    };
    std::vector<Cue> wanted;
    for (const Cue& cue : isMov_ ? withoutOverlaps(expected_.captions, expected_.end) : expected_.captions) {
      const std::int64_t start = rounded(cue.start);
      const std::int64_t end = rounded(cue.end);
      if (!cue.text.empty() && start < end)
        wanted.push_back({start, end, isMov_ ? cue.text : webVttText(cue.text)});
    }
    return wanted;
  }

  void compareCaptions() {
    if (captions_ == nullptr) return;
    const std::vector<Cue> wanted = wantedCues();
    compare("number of captions", found_.size(), wanted.size());
    for (std::size_t i = 0; i < std::min(found_.size(), wanted.size()); ++i) {
      compare(fmt::format("text of caption {}", i + 1), found_[i].text, wanted[i].text);
      compareTime(fmt::format("start of caption {}", i + 1), found_[i].start, wanted[i].start, kMillisecond);
      compareTime(fmt::format("end of caption {}", i + 1), found_[i].end, wanted[i].end, kMillisecond);
    }
  }

  void compareSound() {
    if (sound_ == nullptr) return;
    compare("sound", std::string_view(avcodec_get_name(sound_->codecpar->codec_id)),
            std::string_view(soundName_));
    compare("sound rate", sound_->codecpar->sample_rate, kSoundRate);
    compareTime("end of the sound", soundEnd_, expected_.end, kSoundTolerance);
  }

  const VideoTracks& expected_;
  bool isMov_;
  const std::filesystem::path& name_;
  const char* soundName_ = "";
  libav::InputContext format_;
  const AVStream* sound_ = nullptr;
  const AVStream* captions_ = nullptr;
  std::int64_t soundEnd_ = 0;
  std::vector<Cue> found_;
  std::string differences_;
};

} // namespace

void verifyTracks(const std::filesystem::path& file, Container container, const VideoTracks& expected,
                  const std::filesystem::path& name) {
  if (expected.captions.empty() && expected.chapters.empty() && !expected.sound) return;
  TracksVerifier(file, container, expected, name).run();
}

} // namespace offstage
