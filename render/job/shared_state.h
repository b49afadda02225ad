#pragma once

#include "src/sim/error.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace offstage {

/// Memory that a process and those forked from it write to together: how far every chunk is, and the first
/// error.
class SharedState {
public:
  explicit SharedState(std::int64_t chunks);
  ~SharedState();
  SharedState(const SharedState&) = delete;
  SharedState& operator=(const SharedState&) = delete;

  /// How many of the chunk's frames are done, and their bytes so far. A chunk that is begun again starts
  /// over.
  void setProgress(std::int64_t chunk, std::int64_t frames, std::int64_t bytes);
  [[nodiscard]] std::int64_t frames() const; ///< of all chunks
  [[nodiscard]] std::int64_t bytes() const;

  /// Keeps the first error that any process reports.
  void fail(const Error& error);
  [[nodiscard]] bool failed() const;
  void rethrow() const; ///< throws that error; nothing when there is none

  /// The signal that last ended a worker, 0 when none did.
  void setSignal(int signal) { header().signal = signal; }
  [[nodiscard]] int signal() const { return header().signal; }

private:
  struct Header {
    std::atomic<int> errorState; ///< 0 none, 1 being written, 2 there
    std::atomic<int> signal;
    int code;
    std::size_t length;
    char text[8192];
  };
  struct Chunk {
    std::atomic<std::int64_t> frames;
    std::atomic<std::int64_t> bytes;
  };
  static_assert(std::atomic<std::int64_t>::is_always_lock_free, "processes cannot share a lock");
  [[nodiscard]] Header& header() const { return *static_cast<Header*>(memory_); }
  [[nodiscard]] Chunk& chunk(std::int64_t index) const;

  std::int64_t chunks_;
  std::size_t size_; ///< bytes
  void* memory_ = nullptr;
};

} // namespace offstage
