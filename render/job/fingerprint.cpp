#include "render/job/fingerprint.h"

#include "src/sim/clock.h"

#include <array>
#include <bit>
#include <cstddef>
#include <fstream>

namespace offstage {

void Fingerprint::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  hash_.add(text.data(), text.size());
}

void Fingerprint::add(std::int64_t number) {
  hash_.add(&number, sizeof number);
}

void Fingerprint::add(const Clock& clock) {
  add(clock.steps());
  add(std::bit_cast<std::int64_t>(clock.fps()));
  for (std::int64_t frame = 0; !clock.isFixed() && frame <= clock.steps(); ++frame)
    add(clock.nanoseconds(frame));
}

void Fingerprint::addFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::int64_t size = 0;
  std::array<char, 1U << 16U> block; // NOLINT(cppcoreguidelines-pro-type-member-init)
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    hash_.add(block.data(), static_cast<std::size_t>(stream.gcount()));
    size += stream.gcount();
  }
  add(size);
}

} // namespace offstage
