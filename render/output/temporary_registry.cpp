#include "render/output/temporary_registry.h"

#include "render/output/atomic_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <sys/types.h>
#include <unistd.h>

#include <climits>

namespace offstage {

/// Records form a list that only grows and whose records are used again, so that a signal handler may walk it
/// at any moment: it needs no lock and meets no freed memory. Its length is the greatest number of files that
/// were open at once.
struct TemporaryRecord {
  enum State : int {
    Free,   ///< may be taken by registerTemporary
    Filled, ///< being written; the handler leaves it alone
    Live,   ///< names a temporary file of process `owner`
    Removed ///< the handler has removed the file; never used again, because the process is about to end
  };
  std::atomic<int> state{Filled};
  pid_t owner = 0;
  std::array<char, PATH_MAX> path{};
  TemporaryRecord* next = nullptr;
};

namespace {

std::atomic<TemporaryRecord*> firstRecord{nullptr};
static_assert(std::atomic<TemporaryRecord*>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may use only lock-free atomics");

TemporaryRecord* takeFreeRecord() {
  for (TemporaryRecord* record = firstRecord.load(std::memory_order_acquire); record != nullptr;
       record = record->next) {
    int expected = TemporaryRecord::Free;
    if (record->state.compare_exchange_strong(expected, TemporaryRecord::Filled)) return record;
  }
  auto* record = new TemporaryRecord;
  record->next = firstRecord.load(std::memory_order_relaxed);
  while (!firstRecord.compare_exchange_weak(record->next, record, std::memory_order_release)) {
  }
  return record;
}

} // namespace

TemporaryRecord* registerTemporary(const std::string& absolutePath) {
  if (absolutePath.size() >= PATH_MAX) return nullptr;
  TemporaryRecord* record = takeFreeRecord();
  record->owner = getpid();
  std::memcpy(record->path.data(), absolutePath.c_str(), absolutePath.size() + 1);
  record->state.store(TemporaryRecord::Live, std::memory_order_release);
  return record;
}

void unregisterTemporary(TemporaryRecord* record) noexcept {
  if (record == nullptr) return;
  int expected = TemporaryRecord::Live;
  record->state.compare_exchange_strong(expected, TemporaryRecord::Free);
}

void removeTemporariesFromSignalHandler() noexcept {
  const int savedError = errno;
  const pid_t self = getpid();
  for (TemporaryRecord* record = firstRecord.load(std::memory_order_acquire); record != nullptr;
       record = record->next) {
    if (record->state.load(std::memory_order_acquire) != TemporaryRecord::Live || record->owner != self)
      continue;
    int expected = TemporaryRecord::Live;
    if (record->state.compare_exchange_strong(expected, TemporaryRecord::Removed))
      unlink(record->path.data());
  }
  errno = savedError;
}

} // namespace offstage
