#include "render/output/sound_mix.h"
#include "render/output/sound_reader.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"
#include "tests/support/track_decode.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using ::testing::HasSubstr;

/// Samples as a sound; both channels are the same.
class Samples : public Sound {
public:
  explicit Samples(std::vector<float> samples) : samples_(std::move(samples)) {}
  void rewind() override { at_ = 0; }
  std::size_t read(std::span<float> pairs) override {
    const std::size_t count = std::min(pairs.size() / 2, samples_.size() - at_);
    for (std::size_t i = 0; i < count; ++i) pairs[2 * i] = pairs[2 * i + 1] = samples_[at_ + i];
    at_ += count;
    return count;
  }

private:
  std::vector<float> samples_;
  std::size_t at_ = 0;
};

/// The left channel of a whole sound, read in pieces of an odd size.
std::vector<float> all(Sound& sound) {
  std::vector<float> left;
  std::vector<float> part(2 * 777);
  sound.rewind();
  while (const std::size_t had = sound.read(part))
    for (std::size_t i = 0; i < had; ++i) left.push_back(part[2 * i]);
  return left;
}

float peakOf(const std::vector<float>& samples) {
  float peak = 0.0F;
  for (const float sample : samples) peak = std::max(peak, std::abs(sample));
  return peak;
}

TEST(PeakLimiter, LeavesWhatIsQuietAsItIs) {
  Samples quiet(test::tone(997, 0.3, 0.8, 48000));
  PeakLimiter limiter(quiet);
  EXPECT_EQ(all(limiter), all(quiet));
}

TEST(PeakLimiter, HoldsSamplesAndWhatLiesBetweenThem) {
  // At a quarter of the rate, an eighth of a turn off, every sample is 0.707 of the true peak.
  std::vector<float> tone(24000);
  for (std::size_t i = 0; i < tone.size(); ++i)
    tone[i] = static_cast<float>(1.3 * std::sin((static_cast<double>(i) + 0.5) * 1.5707963267948966));
  Samples loud(tone);
  PeakLimiter limiter(loud);
  const std::vector<float> limited = all(limiter);
  ASSERT_EQ(limited.size(), tone.size());
  const std::vector<float> middle(limited.begin() + 500, limited.end() - 500);
  EXPECT_NEAR(peakOf(middle), kTruePeakCeiling * 0.70710678, 0.02);
}

TEST(PeakLimiter, TurnsDownBeforeAPeakAndUpAfterIt) {
  std::vector<float> samples = test::tone(200, 0.4, 0.3, 48000);
  for (std::size_t i = 9600; i < 9700; ++i) samples[i] *= 6.0F;
  Samples sound(samples);
  PeakLimiter limiter(sound);
  const std::vector<float> limited = all(limiter);
  EXPECT_LE(peakOf(limited), kTruePeakCeiling + 1e-6);
  EXPECT_EQ(limited[5000], samples[5000]);
  EXPECT_NEAR(limited[15000], samples[15000], 1e-6);
  EXPECT_LT(std::abs(limited[9590]), std::abs(samples[9590])); // already on its way down
}

TEST(SoundMix, BringsVoicesToMinus16Lufs) {
  for (const double amplitude : {0.005, 0.1, 0.9}) {
    std::vector<float> speech; // half of it pauses, which the gate leaves out
    for (int i = 0; i < 6; ++i) {
      const std::vector<float> word = test::tone(300.0 + 40.0 * i, 0.7, amplitude, 48000);
      speech.insert(speech.end(), word.begin(), word.end());
      speech.insert(speech.end(), 33600, 0.0F);
    }
    const auto length = static_cast<std::int64_t>(speech.size()) + 48000;
    SoundMix mix({{std::make_shared<Samples>(speech), 24000}}, {}, length);
    EXPECT_NEAR(loudnessOf(mix), -16.0, 0.2) << amplitude;
    const std::vector<float> mixed = all(mix);
    EXPECT_EQ(mixed.size(), static_cast<std::size_t>(length));
    EXPECT_EQ(peakOf({mixed.begin(), mixed.begin() + 23999}), 0.0F);
    EXPECT_LE(peakOf(mixed), kTruePeakCeiling + 1e-6);
  }
}

TEST(SoundMix, SilenceStaysSilent) {
  SoundMix mix({{std::make_shared<Samples>(std::vector<float>(48000, 0.0F)), 0}}, {}, 60000);
  const std::vector<float> mixed = all(mix);
  EXPECT_EQ(mixed.size(), 60000U);
  EXPECT_EQ(peakOf(mixed), 0.0F);
  EXPECT_EQ(mix.gain(), 0.0);
}

TEST(SoundMix, VoicesFollowEachOtherAndOneThatHasBegunIsCut) {
  const std::vector<float> first = test::tone(300, 1.0, 0.1, 48000);
  const std::vector<float> second = test::tone(500, 1.0, 0.1, 48000);
  SoundMix mix({{std::make_shared<Samples>(first), -24000}, {std::make_shared<Samples>(second), 30000}}, {},
               100000);
  const std::vector<float> mixed = all(mix);
  const auto factor = static_cast<float>(std::pow(10.0, mix.gain() / 20.0));
  for (const std::size_t i : {1U, 11111U, 23990U})
    EXPECT_NEAR(mixed[i], factor * first[i + 24000], 1e-4F) << i;
  EXPECT_EQ(mixed[25000], 0.0F);
  for (const std::size_t i : {30001U, 44444U, 77990U})
    EXPECT_NEAR(mixed[i], factor * second[i - 30000], 1e-4F) << i;
  EXPECT_EQ(mixed[78001], 0.0F);
}

TEST(SoundMix, ClicksBeginAtTheirSampleAndAreAsLoudAsTheirShare) {
  SoundMix mix({}, {{0.5, 1.0}, {1.0, 0.0}}, 96000);
  const std::vector<float> mixed = all(mix);
  EXPECT_EQ(peakOf({mixed.begin(), mixed.begin() + 24001}), 0.0F);
  EXPECT_GT(std::abs(mixed[24001]), 0.03F);
  const float loud = peakOf({mixed.begin() + 24000, mixed.begin() + 27000});
  const float soft = peakOf({mixed.begin() + 48000, mixed.begin() + 51000});
  EXPECT_NEAR(soft / loud, 0.15, 1e-3);
  EXPECT_LT(loud, 0.25F);
}

TEST(SoundReader, BringsEveryRateTo48kHz) {
  const test::TempDir dir;
  for (const int rate : {8000, 22050, 44100, 48000, 96000}) {
    test::writeWav(dir / "x.wav", test::tone(440, 1.5, 0.5, rate), rate);
    SoundReader reader(dir / "x.wav");
    EXPECT_NEAR(static_cast<double>(countSamples(reader)), 72000.0, 2.0) << rate;
    reader.rewind();
    const std::vector<float> samples = all(reader);
    const std::vector<float> wanted = test::tone(440, 1.5, 0.5, 48000);
    const float scale =
        peakOf({samples.begin() + 10000, samples.begin() + 20000}) / 0.5F; // how one channel spreads to two
    for (std::size_t i = 10000; i < 60000; i += 997)
      EXPECT_NEAR(samples[i], scale * wanted[i], 0.005) << rate << ' ' << i;
  }
}

TEST(SoundReader, RefusesWhatIsNoSound) {
  const test::TempDir dir;
  const auto problemOf = [](const std::filesystem::path& file) {
    return test::errorOf([&] {
      SoundReader reader(file);
      countSamples(reader);
    });
  };
  EXPECT_THAT(problemOf(dir.write("x.wav", "RIFF????WAVE")), HasSubstr("2: "));
  EXPECT_THAT(problemOf(dir.write("list.m3u8", "#EXTM3U\n#EXTINF:1,\nx.wav\n")),
              HasSubstr("is no sound file that can be read"));
  test::writeWav(dir / "whole.wav", test::tone(440, 1.0, 0.5, 48000), 48000);
  EXPECT_EQ(problemOf(dir / "whole.wav"), "no error");
}

} // namespace
} // namespace offstage
