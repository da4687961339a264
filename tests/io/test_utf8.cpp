// UTF-8 against every code point that there is, and against what is none.
#include "io/utf8.h"

#include <gtest/gtest.h>

namespace hl {
namespace {

TEST(Utf8, GivesBackEveryCodePoint) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t point = 0; point <= 0x10ffff; ++point) {
    if (point < 0xd800 || point > 0xdfff) all.push_back(point);
  }
  EXPECT_EQ(codePointsOf(utf8Of(all)), all);
}

TEST(Utf8, HasTheBytesOfTheStandard) {
  EXPECT_EQ(utf8Of({'A', 0x2262, 0x391, '.'}), "A\xE2\x89\xA2\xCE\x91.");  // RFC 3629, section 7
  EXPECT_EQ(utf8Of({0x233b4}), "\xF0\xA3\x8E\xB4");
}

TEST(Utf8, TakesWhatIsNoneForQuestionMarks) {
  const auto read = [](const std::string& text) { return utf8Of(codePointsOf(text)); };
  EXPECT_EQ(read("a\xFF"
                 "b"),
            "a?b");
  EXPECT_EQ(read("\xC3"), "?");                 // cut
  EXPECT_EQ(read("\xE2\x89"), "??");            // cut
  EXPECT_EQ(read("\xC0\xAF"), "??");            // a slash, too long
  EXPECT_EQ(read("\xE0\x80\xAF"), "???");       // the same
  EXPECT_EQ(read("\xED\xA0\x80"), "???");       // a surrogate
  EXPECT_EQ(read("\xF4\x90\x80\x80"), "????");  // beyond the last one
}

}  // namespace
}  // namespace hl
