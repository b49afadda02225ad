#pragma once

#include "render/output/stream_hash.h"

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace offstage {

class Clock;

/// A hash (XXH3-64) of all that a render is made from, so that the chunks of another one are not taken for
/// its own.
class Fingerprint {
public:
  void add(std::string_view text); ///< its length too, so that "ab", "c" differs from "a", "bc"
  void add(std::int64_t number);
  void add(const Clock& clock);                    ///< the time of every frame
  void addFile(const std::filesystem::path& file); ///< its bytes; a file that cannot be read counts as empty
  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

private:
  StreamHash hash_;
};

} // namespace offstage
