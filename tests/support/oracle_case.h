#pragma once

#include "src/sim/clock.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage::test {

/// Where the reference trajectories, stills and dt logs are.
std::filesystem::path referenceFolder();

/// The setup of a case of the reference trajectories, by its name: "1_fall" … "6g_elastic_separate",
/// "7_projectile". The .json beside each trajectory gives the parameters. Throws std::invalid_argument for an
/// unknown name.
WorldSetup oracleSetup(const std::string& name, std::int64_t seed);

/// The clock of a dt log: a duration in ns a line.
Clock oracleClock(const std::filesystem::path& dtFile);

/// Runs a setup and compares every row of the states, and every event, bit for bit: `stem` + ".csv.gz" and,
/// where it exists, ".events.csv.gz". The states may hold every `stride`-th frame only. Returns "" or the
/// first differences.
std::string compareWithOracle(const WorldSetup& setup, const Clock& clock, const std::filesystem::path& stem,
                              std::int64_t stride = 1);

} // namespace offstage::test
