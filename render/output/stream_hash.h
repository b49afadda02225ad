#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace offstage {

/// XXH3-64 of bytes that come piece by piece.
class StreamHash {
public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;

  void add(const void* data, std::size_t size);
  [[nodiscard]] std::uint64_t value() const; ///< of all pieces so far

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace offstage
