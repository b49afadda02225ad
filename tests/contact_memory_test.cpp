#include "src/sim/contact_memory.h"

#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

TEST(ContactMemory, FollowsTheBodiesThatAreLeft) {
  ContactMemory memory;
  memory.remember(6, [](auto&& visit) {
    visit(0U, ContactMemory::Entry{1, 1.0F});
    visit(0U, ContactMemory::Entry{4, 2.0F});
    visit(3U, ContactMemory::Entry{5, 3.0F});
    visit(5U, ContactMemory::Entry{ContactMemory::kFirstWall + 3, 4.0F});
  });
  memory.setRubbing(*memory.find(3, 5), 0.5F);
  EXPECT_EQ(memory.find(0, 2), nullptr);
  EXPECT_EQ(memory.find(9, 10), nullptr) << "a body that came since";
  memory.keepOnly(std::vector<std::uint8_t>{0, 1, 1, 0, 0, 0, 0}); // a seventh had come and stays
  EXPECT_EQ(memory.find(0, 1), nullptr) << "the other one has gone";
  ASSERT_NE(memory.find(0, 2), nullptr);
  EXPECT_EQ(memory.find(0, 2)->impulse, 2.0F);
  ASSERT_NE(memory.find(1, 3), nullptr);
  EXPECT_EQ(memory.rubbing(*memory.find(1, 3)), 0.5F);
  EXPECT_EQ(memory.rubbing(*memory.find(0, 2)), 0.0F);
  ASSERT_NE(memory.find(3, ContactMemory::kFirstWall + 3), nullptr);
  EXPECT_EQ(memory.find(3, ContactMemory::kFirstWall + 3)->impulse, 4.0F);
}

} // namespace
} // namespace offstage::test
