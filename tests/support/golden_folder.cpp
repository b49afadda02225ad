#include "tests/support/golden_folder.h"

#include <fmt/core.h>

namespace offstage::test {

ProcessResult GoldenFolder::golden(std::vector<std::string> words) const {
  words.insert(words.begin(), "golden");
  ProcessOptions options;
  options.directory = dir_.path();
  return offstage(std::move(words), options);
}

void GoldenFolder::writeScene(const std::string& name, const std::string& fill, double gravity,
                              const std::string& golden) const {
  dir_.write(name + ".toml",
             fmt::format("duration = 1\n[frame]\nsize = [64, 48]\n[world]\ngravity = [0, {}]\n[walls]\n"
                         "bottom = 0.5\n[[body]]\nname = \"ball\"\ncenter = [20, 10]\nradius = 6\n"
                         "velocity = [16, 0]\nfill = \"{}\"\n[golden]\n{}\n",
                         gravity, fill, golden));
}

} // namespace offstage::test
