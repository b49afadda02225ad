#pragma once

#include "src/sim/error.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace offstage {

/// Memory that a process and those forked from it write to together: who makes which chunk, how far every
/// chunk is, and the first error.
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

  /// Takes a chunk for the calling process; false when it is taken.
  bool claim(std::int64_t chunk);
  [[nodiscard]] bool claimed(std::int64_t chunk) const;
  /// Counts a chunk that is made; how many are now.
  std::int64_t countMade() { return ++header().made; }
  void beginRound(); ///< nothing is claimed, nothing counted

  /// s: how long the simulation takes for a frame, as the process that steps ahead has found; 0 before.
  void setStepSeconds(double seconds) { header().stepSeconds = seconds; }
  [[nodiscard]] double stepSeconds() const { return header().stepSeconds; }

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
    std::atomic<double> stepSeconds;
    std::atomic<std::int64_t> made;
    int code;
    std::size_t length;
    char text[8192];
  };
  struct Chunk {
    std::atomic<bool> claimed;
    std::atomic<std::int64_t> frames;
    std::atomic<std::int64_t> bytes;
  };
  static_assert(std::atomic<std::int64_t>::is_always_lock_free && std::atomic<double>::is_always_lock_free &&
                    std::atomic<bool>::is_always_lock_free,
                "processes cannot share a lock");
  [[nodiscard]] Header& header() const { return *static_cast<Header*>(memory_); }
  [[nodiscard]] Chunk& chunk(std::int64_t index) const;

  std::int64_t chunks_;
  std::size_t size_; ///< bytes
  void* memory_ = nullptr;
};

} // namespace offstage
