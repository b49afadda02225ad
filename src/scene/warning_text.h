#pragma once

#include "src/sim/warning.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

struct Scene;

/// What a kind of warning is called, by its number in Warning::what: "lost", "energy", "crossing", "step".
std::span<const std::string_view> warningWords();

/// Tells a scene's warnings in words: frame, time and body, what is wrong, and what to change.
class WarningText {
public:
  /// Of one that has no file, such as an exercise written in C++.
  WarningText() = default;
  /// `panel`: the title of the panel whose scene it is; empty: of none.
  explicit WarningText(const Scene& scene, std::string panel = {});

  /// One line, without the file: "frame 31 (0.516667 s), body 0 \"ball\": … [energy]".
  [[nodiscard]] std::string of(const Warning& warning) const;
  /// Whether the scene is meant to show this: `[world] expect`.
  [[nodiscard]] bool isExpected(const Warning& warning) const;
  /// The scene's file, as it was given; empty: none.
  [[nodiscard]] const std::string& file() const { return file_; }

private:
  [[nodiscard]] std::string bodyName(std::uint32_t id) const;
  [[nodiscard]] std::string textOfCrossing(const Crossing& crossing) const;
  [[nodiscard]] std::string textOfEdge(Side side) const;
  [[nodiscard]] std::string stepsFor(const Crossing& crossing) const;

  std::string file_;
  std::string panel_;
  std::vector<std::string> names_;  ///< by id
  std::vector<std::string> groups_; ///< by index
  std::vector<std::size_t> expected_;
  int substeps_ = 1;
  Stepping::Form form_ = Stepping::Form::Variable;
  bool solver_ = false; ///< it has the contact solver
  bool clamps_ = true;  ///< its walls
};

} // namespace offstage
