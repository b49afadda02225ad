#pragma once

#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <string>
#include <vector>

namespace offstage::test {

/// A folder of scenes and their goldens, with the commands on it.
class GoldenFolder {
public:
  /// Runs `offstage golden WORDS` where out/golden is inside the folder.
  [[nodiscard]] ProcessResult golden(std::vector<std::string> words) const;

  [[nodiscard]] const TempDir& dir() const { return dir_; }
  /// Writes a small scene: a ball of this colour that falls with this gravity, kept at these moments.
  void writeScene(const std::string& name, const std::string& fill, double gravity,
                  const std::string& golden = "at = [0, 0.5]") const;

private:
  TempDir dir_;
};

} // namespace offstage::test
