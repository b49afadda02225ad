#include "src/sim/random.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// One draw of a kind of the reference, as text; doubles are compared by bits, so they are drawn into
/// `value`.
std::string drawSpawn(Random& random) {
  const int x = random.nextInt(640);
  const int y = random.nextInt(480);
  const int r = random.nextInt(50);
  return std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(r);
}

TEST(Random, EqualsJavaUtilRandomBitForBit) {
  const std::map<std::string, std::function<std::string(Random&)>> kinds{
      {"nextInt()", [](Random& r) { return std::to_string(r.nextInt()); }},
      {"nextLong()", [](Random& r) { return std::to_string(r.nextLong()); }},
      {"nextBoolean()", [](Random& r) { return std::string(r.nextBoolean() ? "true" : "false"); }},
      {"nextDouble()", [](Random& r) { return show(r.nextDouble()); }},
      {"nextFloat()", [](Random& r) { return show(static_cast<double>(r.nextFloat())); }},
      {"spawn(640;480;50)", drawSpawn}};
  const auto lines = splitCsv(readReferenceText(referenceFolder() / "trajectories/out/random_vectors.csv"));
  int compared = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    Random random(std::stoll(lines[i][0]));
    const std::string& kind = lines[i][1];
    const bool isDouble = kind == "nextDouble()" || kind == "nextFloat()";
    for (std::size_t j = 2; j < lines[i].size(); ++j) {
      const std::string expected = isDouble ? show(parseHexDouble(lines[i][j])) : lines[i][j];
      const auto found = kinds.find(kind);
      const std::string drawn = found != kinds.end()
                                    ? found->second(random)
                                    : std::to_string(random.nextInt(std::stoi(kind.substr(8))));
      ASSERT_EQ(drawn, expected) << "seed " << lines[i][0] << ' ' << kind << ", draw " << j - 2;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 8 * 17 * 16);
}

TEST(Random, NextGaussianEqualsJavaUtilRandomBitForBit) {
  const auto lines = splitCsv(readReferenceText(referenceFolder() / "more/random_gaussian.csv"));
  ASSERT_EQ(lines.size(), 9U);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    Random random(std::stoll(lines[i][0]));
    for (std::size_t j = 1; j < lines[i].size(); ++j) {
      const double value = random.nextGaussian();
      ASSERT_TRUE(sameBits(value, parseHexDouble(lines[i][j])))
          << "seed " << lines[i][0] << ", draw " << j << ": " << show(value) << " instead of " << lines[i][j];
    }
  }
}

TEST(Random, SetSeedForgetsTheStoredGaussian) {
  Random random(5);
  const double first = random.nextGaussian();
  random.setSeed(5);
  EXPECT_EQ(random.nextGaussian(), first);
}

TEST(Random, CopyGoesOnWithTheSameDraws) {
  Random random(99);
  random.nextGaussian();
  Random copy = random;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(copy.nextGaussian(), random.nextGaussian()) << "draw " << i;
}

TEST(Random, RefusesABoundThatIsNotPositive) {
  Random random(1);
  EXPECT_THROW(random.nextInt(0), std::invalid_argument);
  EXPECT_THROW(random.nextInt(-7), std::invalid_argument);
}

} // namespace
} // namespace offstage::test
