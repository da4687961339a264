// The names of the ways in which a tick ends: metrics, states and hl trace distinguish them by these alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "proxy/proxy.h"

namespace hl::test_ending {
namespace {

TEST(Ending, EachHasANameOfItsOwnInSmallLettersAndUnderscores) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kEndings; ++i) {
    const char* name = nameOf(static_cast<Ending>(i));
    ASSERT_NE(name, nullptr) << i;
    const std::string text = name;
    EXPECT_FALSE(text.empty()) << i;
    EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; }))
        << text;
    EXPECT_TRUE(names.insert(text).second) << text << " occurs twice";
  }
}

TEST(Ending, TheNamesAreInTheOrderOfTheEndings) {
  EXPECT_STREQ(nameOf(Ending::kGoesOn), "goes_on");
  EXPECT_STREQ(nameOf(Ending::kReached), "reached");
  EXPECT_STREQ(nameOf(Ending::kNoEnergy), "no_energy");
  EXPECT_STREQ(nameOf(Ending::kOutOfWork), "out_of_work");
  EXPECT_STREQ(nameOf(Ending::kInvalid), "invalid");
  EXPECT_EQ(static_cast<std::size_t>(Ending::kInvalid) + 1, kEndings);
}

}  // namespace
}  // namespace hl::test_ending
