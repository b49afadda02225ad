#include "tests/support/allocation_count.h"

#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__)

namespace offstage::test {

std::optional<std::size_t> allocationsSinceLastCall() {
  return std::nullopt;
}

} // namespace offstage::test

#else

namespace {

thread_local std::size_t count = 0; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void* allocate(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory; // NOLINT(cppcoreguidelines-no-malloc)
  throw std::bad_alloc();
}

void* allocate(std::size_t size, std::align_val_t alignment) {
  ++count;
  const auto step = static_cast<std::size_t>(alignment);
  const std::size_t whole = (size + step - 1) / step * step; // as aligned_alloc wants it
  if (void* memory = std::aligned_alloc(step, whole == 0 ? step : whole)) return memory;
  throw std::bad_alloc();
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
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete[](void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete(void* memory) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete[](void* memory) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}
void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc)
}

namespace offstage::test {

std::optional<std::size_t> allocationsSinceLastCall() {
  const std::size_t counted = count;
  count = 0;
  return counted;
}

} // namespace offstage::test

#endif
