#include "tests/support/process.h"
#include "tests/support/reference_csv.h"
#include "tests/support/temp_dir.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

const std::filesystem::path kReference = OFFSTAGE_SOURCE_DIR "/tests/reference";

double number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_TRUE(error == std::errc{} && end == text.data() + text.size()) << "not a double: " << text;
  return value;
}

/// The rows that `offstage trace SCENE --dt LOG` prints, cell by cell, without the header.
std::vector<std::vector<std::string>> traced(const std::string& scene, const std::string& log) {
  const ProcessResult result = offstage({"trace", (kReference / "oracle_scenes" / (scene + ".toml")).string(),
                                         "--dt", (kReference / "trajectories/dt" / (log + ".txt")).string()});
  EXPECT_EQ(result.status, 0) << result.err;
  std::vector<std::vector<std::string>> rows = splitCsv(result.out);
  EXPECT_FALSE(rows.empty());
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

/// Every trajectory of the reference whose name begins with a scene's: "6a_elastic__dt60" belongs to
/// 6a_elastic.toml.
struct Case {
  std::string scene;
  std::string log;
};

std::vector<Case> cases(bool integrators) {
  std::vector<Case> all;
  for (const auto& entry : std::filesystem::directory_iterator(kReference / "trajectories/out")) {
    const std::string name = entry.path().filename().string();
    const std::size_t split = name.find("__");
    if (split == std::string::npos || !name.ends_with(".csv.gz") || name.ends_with(".events.csv.gz"))
      continue;
    const std::string scene = name.substr(0, split);
    if (scene == "0_clock" || scene.starts_with("8_") != integrators) continue;
    all.push_back({scene, name.substr(split + 2, name.size() - split - 2 - std::string(".csv.gz").size())});
  }
  return all;
}

TEST(OracleTrace, EveryCaseIsTheJvmsBitForBit) {
  const std::vector<Case> all = cases(false);
  EXPECT_GE(all.size(), 10U);
  for (const Case& one : all) {
    const ReferenceCsv expected(kReference / "trajectories/out" / (one.scene + "__" + one.log + ".csv.gz"));
    const std::vector<std::vector<std::string>> actual = traced(one.scene, one.log);
    ASSERT_EQ(actual.size(), expected.rows()) << one.scene << " " << one.log;
    for (std::size_t row = 0; row < actual.size(); ++row) {
      ASSERT_EQ(actual[row].at(0), expected.cell(row, "frame")) << one.scene << " row " << row;
      std::size_t column = 2;
      for (const char* name : {"time_hex", "x_hex", "y_hex", "vx_hex", "vy_hex", "radius_hex"}) {
        const double got = number(actual[row].at(column++));
        const double wanted = expected.hex(row, name);
        ASSERT_TRUE(sameBits(got, wanted))
            << one.scene << " " << one.log << " frame " << actual[row][0] << " row " << row << " " << name
            << ": " << show(got) << ", JVM " << show(wanted);
      }
    }
  }
}

TEST(OracleTrace, IntegratorsAreTheJvmsBitForBitAndExactWithinANanopixel) {
  const std::vector<Case> all = cases(true);
  EXPECT_EQ(all.size(), 3U);
  for (const Case& one : all) {
    const ReferenceCsv expected(kReference / "trajectories/out" / (one.scene + "__" + one.log + ".csv.gz"));
    const std::vector<std::vector<std::string>> actual = traced(one.scene, one.log);
    ASSERT_EQ(actual.size(), expected.rows()) << one.scene;
    for (std::size_t row = 0; row < actual.size(); ++row) {
      const std::string& method = expected.cell(row, "method");
      std::size_t column = 2;
      for (const char* name : {"time_hex", "x_hex", "y_hex", "vx_hex", "vy_hex"}) {
        const double got = number(actual[row].at(column++));
        const double wanted = expected.hex(row, name);
        if (method == "exact")
          ASSERT_NEAR(got, wanted, 1e-9) << one.scene << " frame " << actual[row][0] << " " << name;
        else
          ASSERT_TRUE(sameBits(got, wanted)) << one.scene << " " << method << " frame " << actual[row][0]
                                             << " " << name << ": " << show(got) << ", JVM " << show(wanted);
      }
    }
  }
}

TEST(OracleTrace, EventsAreTheJvmsInOrder) {
  const TempDir dir;
  int compared = 0;
  for (const Case& one : cases(false)) {
    const std::filesystem::path reference =
        kReference / "trajectories/out" / (one.scene + "__" + one.log + ".events.csv.gz");
    if (!std::filesystem::exists(reference)) continue;
    const ReferenceCsv expected(reference);
    const std::string file = dir / "events.csv";
    const ProcessResult result =
        offstage({"trace", (kReference / "oracle_scenes" / (one.scene + ".toml")).string(), "--dt",
                  (kReference / "trajectories/dt" / (one.log + ".txt")).string(), "-o", dir / "x.csv",
                  "--events", file});
    ASSERT_EQ(result.status, 0) << result.err;
    std::vector<std::vector<std::string>> actual = splitCsv(readFile(file));
    ASSERT_FALSE(actual.empty());
    actual.erase(actual.begin());
    ASSERT_EQ(actual.size(), expected.rows()) << one.scene;
    for (std::size_t row = 0; row < actual.size(); ++row) {
      // The oracle calls the lower wall "floor" where it is the only one.
      const std::string name =
          expected.cell(row, "event") == "floor" ? "bottom" : expected.cell(row, "event");
      EXPECT_EQ(actual[row].at(0), expected.cell(row, "frame")) << one.scene << " row " << row;
      EXPECT_EQ(actual[row].at(1), name) << one.scene << " row " << row;
      EXPECT_TRUE(sameBits(number(actual[row].at(5)), expected.hex(row, "p_hex")))
          << one.scene << " row " << row;
      EXPECT_TRUE(sameBits(number(actual[row].at(6)), expected.hex(row, "q_hex")))
          << one.scene << " row " << row;
    }
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

} // namespace
} // namespace offstage::test
