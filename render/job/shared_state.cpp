#include "render/job/shared_state.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <sys/mman.h>

namespace offstage {

SharedState::SharedState(std::int64_t chunks)
    : chunks_(chunks), size_(sizeof(Header) + static_cast<std::size_t>(chunks) * sizeof(Chunk)) {
  // Fresh anonymous memory is zero, which is the beginning of everything here.
  memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED) throw std::bad_alloc();
}

SharedState::~SharedState() {
  munmap(memory_, size_);
}

SharedState::Chunk& SharedState::chunk(std::int64_t index) const {
  return reinterpret_cast<Chunk*>(static_cast<char*>(memory_) + sizeof(Header))[index];
}

void SharedState::setProgress(std::int64_t index, std::int64_t frames, std::int64_t bytes) {
  chunk(index).frames = frames;
  chunk(index).bytes = bytes;
}

std::int64_t SharedState::frames() const {
  std::int64_t sum = 0;
  for (std::int64_t index = 0; index < chunks_; ++index) sum += chunk(index).frames;
  return sum;
}

std::int64_t SharedState::bytes() const {
  std::int64_t sum = 0;
  for (std::int64_t index = 0; index < chunks_; ++index) sum += chunk(index).bytes;
  return sum;
}

bool SharedState::claim(std::int64_t index) {
  return !chunk(index).claimed.exchange(true);
}

bool SharedState::claimed(std::int64_t index) const {
  return chunk(index).claimed;
}

void SharedState::beginRound() {
  header().made = 0;
  for (std::int64_t index = 0; index < chunks_; ++index) chunk(index).claimed = false;
}

void SharedState::fail(const Error& error) {
  int none = 0;
  if (!header().errorState.compare_exchange_strong(none, 1)) return;
  const std::size_t length = std::min(std::strlen(error.what()), sizeof header().text);
  std::memcpy(header().text, error.what(), length);
  header().length = length;
  header().code = static_cast<int>(error.code());
  header().errorState = 2;
}

bool SharedState::failed() const {
  return header().errorState == 2;
}

void SharedState::rethrow() const {
  if (failed())
    throw Error(static_cast<ExitCode>(header().code), std::string(header().text, header().length));
}

} // namespace offstage
