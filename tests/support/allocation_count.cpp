#include "tests/support/allocation_count.h"

#include <cstdlib>
#include <malloc.h>
#include <new>

#if defined(__SANITIZE_ADDRESS__)

namespace offstage::test {

std::optional<std::size_t> allocationsSinceLastCall() {
  return std::nullopt;
}
std::optional<std::ptrdiff_t> bytesHeld() {
  return std::nullopt;
}

} // namespace offstage::test

#else

namespace {

thread_local std::size_t count = 0;   // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
thread_local std::ptrdiff_t held = 0; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++count;
  held += static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
  return memory;
}

void* allocate(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size)); // NOLINT(cppcoreguidelines-no-malloc)
}

void* allocate(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  const std::size_t whole = (size + step - 1) / step * step; // as aligned_alloc wants it
  return counted(std::aligned_alloc(step, whole == 0 ? step : whole));
}

void release(void* memory) {
  held -= static_cast<std::ptrdiff_t>(malloc_usable_size(memory)); // of null: 0
  std::free(memory);                                               // NOLINT(cppcoreguidelines-no-malloc)
}

} // namespace

// The whole program's, so that what the library and the drivers allocate counts too.
void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, alignment);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  release(memory);
}

namespace offstage::test {

std::optional<std::size_t> allocationsSinceLastCall() {
  const std::size_t allocations = count;
  count = 0;
  return allocations;
}
std::optional<std::ptrdiff_t> bytesHeld() {
  return held;
}

} // namespace offstage::test

#endif
