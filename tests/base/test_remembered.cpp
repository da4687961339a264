// What was last asked for is remembered, within the bytes given.
#include "base/remembered.h"

#include <gtest/gtest.h>

#include <string>

namespace hl::test_remembered {
namespace {

TEST(Remembered, ForgetsWhatWasAskedForLongestAgo) {
  Remembered<int, std::string> remembered(20);
  remembered.keep(1, "one", 10);
  remembered.keep(2, "two", 10);
  EXPECT_EQ(remembered.find(1), "one") << "the other was asked for longer ago now";
  remembered.keep(3, "three", 10);
  EXPECT_EQ(remembered.find(1), "one");
  EXPECT_EQ(remembered.find(2), std::nullopt);
  EXPECT_EQ(remembered.find(3), "three");
}

TEST(Remembered, DoesNotKeepWhatIsLargerThanAll) {
  Remembered<int, std::string> remembered(20);
  remembered.keep(1, "one", 10);
  remembered.keep(2, "two", 21);
  EXPECT_EQ(remembered.find(1), "one");
  EXPECT_EQ(remembered.find(2), std::nullopt);
  remembered.keep(3, "three", 20);
  EXPECT_EQ(remembered.find(1), std::nullopt);
  EXPECT_EQ(remembered.find(3), "three");
}

}  // namespace
}  // namespace hl::test_remembered
