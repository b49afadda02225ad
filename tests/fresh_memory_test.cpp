#include "render/job/fresh_memory.h"
#include "tests/support/temp_dir.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kPages = 2000; // more than are asked about at once

/// Pages of the system.
class Mapping {
public:
  explicit Mapping(int flags, int file = -1)
      : memory_(static_cast<std::uint8_t*>(
            mmap(nullptr, kPages * kPage, PROT_READ | PROT_WRITE, flags, file, 0))) {
    if (memory_ == MAP_FAILED) throw std::runtime_error("mmap");
  }
  ~Mapping() { munmap(memory_, kPages * kPage); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  [[nodiscard]] std::uint8_t* page(std::size_t number) const { return memory_ + number * kPage; }
  [[nodiscard]] bool isFresh() const { return isFreshMemory(memory_, kPages * kPage); }

private:
  std::uint8_t* memory_;
};

TEST(FreshMemory, IsWhatNobodyHasTouched) {
  const Mapping mapping(MAP_PRIVATE | MAP_ANONYMOUS);
  errno = EDOM;
  EXPECT_TRUE(mapping.isFresh());
  EXPECT_EQ(errno, EDOM);
  EXPECT_TRUE(isFreshMemory(mapping.page(3) + 100, 5 * kPage));
  *mapping.page(kPages - 2) = 1;
  EXPECT_FALSE(mapping.isFresh());
  EXPECT_TRUE(isFreshMemory(mapping.page(0), (kPages - 2) * kPage));
  EXPECT_TRUE(isFreshMemory(mapping.page(kPages - 1), kPage));
  EXPECT_FALSE(isFreshMemory(mapping.page(kPages - 1) - 1, kPage));
  volatile const std::uint8_t* const first = mapping.page(0);
  EXPECT_EQ(*first, 0); // a page that was only read is as good as any, and cheap to leave alone
  EXPECT_FALSE(isFreshMemory(mapping.page(0), 10 * kPage));
}

TEST(FreshMemory, IsNoFilesAndNobodyElses) {
  const TempDir dir;
  const std::string text(kPages * kPage, 'x');
  const int file = open(dir.write("file", text).c_str(), O_RDWR | O_CLOEXEC);
  EXPECT_FALSE(Mapping(MAP_SHARED | MAP_ANONYMOUS).isFresh());
  EXPECT_FALSE(Mapping(MAP_PRIVATE, file).isFresh());
  EXPECT_FALSE(Mapping(MAP_SHARED, file).isFresh());
  const Mapping mixed(MAP_PRIVATE | MAP_ANONYMOUS);
  ASSERT_NE(mmap(mixed.page(7), kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED, file, 0), MAP_FAILED);
  EXPECT_FALSE(mixed.isFresh());
  EXPECT_TRUE(isFreshMemory(mixed.page(8), 100 * kPage));
  close(file);
}

TEST(FreshMemory, OfLessThanAPageOrOfNothingThereIsNone) {
  const Mapping mapping(MAP_PRIVATE | MAP_ANONYMOUS);
  EXPECT_FALSE(isFreshMemory(mapping.page(0), kPage - 1));
  EXPECT_FALSE(isFreshMemory(mapping.page(0), 0));
  const std::uint8_t local[2 * kPage] = {};
  EXPECT_FALSE(isFreshMemory(local, sizeof local));
  std::uint8_t* const gone = Mapping(MAP_PRIVATE | MAP_ANONYMOUS).page(0);
  EXPECT_FALSE(isFreshMemory(gone, kPages * kPage));
}

} // namespace
} // namespace offstage::test
