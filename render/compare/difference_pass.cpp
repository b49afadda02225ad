#include "render/compare/difference_pass.h"

#include "render/compare/parallel.h"
#include "render/compare/pixelmatch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace offstage {
namespace {

constexpr std::size_t kWorst = 10;
constexpr int kRowsAPart = 32;

bool worseThan(const PixelPair& a, const PixelPair& b) {
  return std::tuple(-a.difference, a.y, a.x) < std::tuple(-b.difference, b.y, b.x);
}

/// The worst pixels so far, worst first.
class Worst {
public:
  explicit Worst(std::size_t most) : most_(most) {}

  /// Whether a pixel of this difference can be among them.
  [[nodiscard]] bool wants(double difference) const {
    return pixels_.size() < most_ || difference >= pixels_.back().difference;
  }
  void add(const PixelPair& pixel) {
    pixels_.insert(std::ranges::upper_bound(pixels_, pixel, worseThan), pixel);
    if (pixels_.size() > most_) pixels_.pop_back();
  }
  void add(const Worst& other) {
    for (const PixelPair& pixel : other.pixels_) add(pixel);
  }
  [[nodiscard]] const std::vector<PixelPair>& pixels() const { return pixels_; }

private:
  std::size_t most_;
  std::vector<PixelPair> pixels_;
};

/// |difference| of the four channels, what is hidden left out.
template <class Channel>
std::array<int, 4> channelDifferences(const Channel* a, const Channel* b, bool strictAlpha) {
  std::array<int, 4> d{};
  d[3] = std::abs(a[3] - b[3]);
  if (!strictAlpha && (a[3] == 0 || b[3] == 0)) return d;
  for (std::size_t c = 0; c < 3; ++c) d[c] = std::abs(a[c] - b[c]);
  return d;
}

/// One row of a picture in 8 or 16 bits a channel.
template <class Channel>
class RowReader {
public:
  explicit RowReader(const PixelRows& rows)
      : rows_(rows), buffer_(4UL * static_cast<std::size_t>(rows.width())) {}
  const Channel* read(int y) {
    if constexpr (std::is_same_v<Channel, std::uint8_t>)
      return rows_.row8(y, buffer_.data());
    else {
      rows_.row16(y, buffer_.data());
      return buffer_.data();
    }
  }

private:
  const PixelRows& rows_;
  std::vector<Channel> buffer_;
};

/// What one thread finds.
struct Found {
  DifferenceSums sums;
  Worst worst{kWorst};
  Worst worstForgiven{1};
  std::int64_t forgiven = 0;
};

template <class Channel>
class Pass {
public:
  Pass(const PixelRows& expected, const PixelRows& actual, const DifferenceRules& rules)
      : expected_(expected), actual_(actual), rules_(rules), alike_(expected.layout() == actual.layout()) {
    result_.unit = std::is_same_v<Channel, std::uint8_t> ? 1.0 : 1.0 / 257.0;
    limit_ = static_cast<int>(std::floor(rules.maxChannel / result_.unit + 1e-9));
    result_.differing = BitPlane(expected.width(), expected.height());
    if (rules.forgiveAntialiasing) result_.forgiven = BitPlane(expected.width(), expected.height());
  }

  DifferencePass run() {
    if (&expected_ == &actual_) return std::move(result_);
    std::vector<Found> found(static_cast<std::size_t>(std::max(1, rules_.threads)));
    parallelFor(expected_.height(), kRowsAPart, rules_.threads, [&](int worker, int begin, int end) {
      Found& here = found[static_cast<std::size_t>(worker)];
      findIn(begin, end, here);
    });
    if (rules_.forgiveAntialiasing) {
      parallelFor(expected_.height(), kRowsAPart, rules_.threads, [&](int worker, int begin, int end) {
        forgiveIn(begin, end, found[static_cast<std::size_t>(worker)]);
      });
    }
    Found all;
    for (const Found& part : found) {
      DifferenceSums& sums = result_.sums;
      sums.unequal += part.sums.unequal;
      sums.colorSum += part.sums.colorSum;
      sums.alphaSum += part.sums.alphaSum;
      sums.colorSquares += part.sums.colorSquares;
      sums.alphaSquares += part.sums.alphaSquares;
      sums.largest = std::max(sums.largest, part.sums.largest);
      result_.forgivenCount += part.forgiven;
      all.worst.add(part.worst);
      all.worstForgiven.add(part.worstForgiven);
    }
    result_.worst = all.worst.pixels();
    result_.worstForgiven = all.worstForgiven.pixels();
    return std::move(result_);
  }

private:
  void findIn(int begin, int end, Found& found) {
    RowReader<Channel> expected(expected_);
    RowReader<Channel> actual(actual_);
    for (int y = begin; y < end; ++y) {
      if (alike_) {
        const auto stored = expected_.stored(y);
        if (std::memcmp(stored.data(), actual_.stored(y).data(), stored.size()) == 0) continue;
      }
      findInRow(expected.read(y), actual.read(y), y, found);
    }
  }

  void findInRow(const Channel* a, const Channel* b, int y, Found& found) {
    constexpr int kStep = 16; // px compared at once
    const int width = expected_.width();
    for (int from = 0; from < width; from += kStep) {
      const int to = std::min(width, from + kStep);
      const auto at = 4 * static_cast<std::size_t>(from);
      if (std::memcmp(a + at, b + at, sizeof(Channel) * 4 * static_cast<std::size_t>(to - from)) == 0)
        continue;
      for (int x = from; x < to; ++x)
        findAt(a + 4 * static_cast<std::size_t>(x), b + 4 * static_cast<std::size_t>(x), x, y, found);
    }
  }

  void findAt(const Channel* a, const Channel* b, int x, int y, Found& found) {
    if (std::memcmp(a, b, 4 * sizeof(Channel)) == 0) return;
    const std::array<int, 4> d = channelDifferences(a, b, rules_.strictAlpha);
    const int largest = std::max(std::max(d[0], d[1]), std::max(d[2], d[3]));
    if (largest == 0 || (rules_.ignored != nullptr && rules_.ignored->get(x, y))) return;
    DifferenceSums& sums = found.sums;
    ++sums.unequal;
    sums.colorSum += d[0] + d[1] + d[2];
    sums.alphaSum += d[3];
    for (std::size_t c = 0; c < 3; ++c) sums.colorSquares += square(d[c]);
    sums.alphaSquares += square(d[3]);
    sums.largest = std::max(sums.largest, largest);
    if (largest <= limit_) return;
    result_.differing.set(x, y);
    if (!rules_.forgiveAntialiasing) note(a, b, x, y, largest, found.worst);
  }

  static std::uint64_t square(int d) { return static_cast<std::uint64_t>(d) * static_cast<std::uint64_t>(d); }

  void note(const Channel* a, const Channel* b, int x, int y, int difference, Worst& worst) const {
    if (!worst.wants(difference * result_.unit)) return;
    PixelPair pixel{x, y, {}, {}, difference * result_.unit};
    for (std::size_t c = 0; c < 4; ++c) {
      pixel.expected[c] = a[c] * result_.unit;
      pixel.actual[c] = b[c] * result_.unit;
    }
    worst.add(pixel);
  }

  /// Moves the pixels that look antialiased from `differing` to `forgiven`.
  void forgiveIn(int begin, int end, Found& found) {
    RowWindow expectedWindow(expected_);
    RowWindow actualWindow(actual_);
    RowReader<Channel> expected(expected_);
    RowReader<Channel> actual(actual_);
    for (int y = begin; y < end; ++y) {
      if (result_.differing.countRow(y) == 0) continue;
      expectedWindow.moveTo(y);
      actualWindow.moveTo(y);
      const Channel* a = expected.read(y);
      const Channel* b = actual.read(y);
      result_.differing.forEachInRow(y, [&](int x) {
        const auto at = 4 * static_cast<std::size_t>(x);
        const std::array<int, 4> d = channelDifferences(a + at, b + at, rules_.strictAlpha);
        const int largest = *std::ranges::max_element(d);
        const bool forgive = looksAntialiased(expectedWindow, actualWindow, x) ||
                             looksAntialiased(actualWindow, expectedWindow, x);
        if (forgive) {
          result_.forgiven.set(x, y);
          ++found.forgiven;
        }
        note(a + at, b + at, x, y, largest, forgive ? found.worstForgiven : found.worst);
      });
      for (std::size_t i = 0; i < result_.differing.wordsPerRow(); ++i)
        result_.differing.row(y)[i] &= ~result_.forgiven.row(y)[i];
    }
  }

  const PixelRows& expected_;
  const PixelRows& actual_;
  const DifferenceRules& rules_;
  const bool alike_;
  int limit_ = 0;
  DifferencePass result_;
};

} // namespace

DifferencePass findDifferences(const PixelRows& expected, const PixelRows& actual,
                               const DifferenceRules& rules) {
  if (expected.deep() || actual.deep()) return Pass<std::uint16_t>(expected, actual, rules).run();
  return Pass<std::uint8_t>(expected, actual, rules).run();
}

} // namespace offstage
