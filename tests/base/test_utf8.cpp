// UTF-8, against the ranges of RFC 3629.
#include "base/utf8.h"

#include <gtest/gtest.h>

namespace hl::test_utf8 {
namespace {

std::string encoded(std::uint32_t code) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80U | (code >> shift & 0x3fU)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xc0U | code >> 6), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xe0U | code >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xf0U | code >> 18), tail(12), tail(6), tail(0)};
}

TEST(Utf8, EveryCharacterIsOne) {
  for (std::uint32_t code = 0; code < 0x120000; ++code) {
    const bool sound = code < 0x110000 && (code < 0xd800 || code > 0xdfff);
    ASSERT_EQ(isUtf8(encoded(code)), sound) << code;
    ASSERT_TRUE(isUtf8(validUtf8("a" + encoded(code)))) << code;
    if (sound) {
      ASSERT_EQ(validUtf8(encoded(code)), encoded(code)) << code;
    }
  }
}

TEST(Utf8, CodePointsAreGivenBack) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t point = 0; point < 0x110000; ++point) {
    if (point < 0xd800 || point > 0xdfff) all.push_back(point);
  }
  EXPECT_EQ(codePointsOf(utf8Of(all)), all);
  EXPECT_EQ(utf8Of({'A', 0x2262, 0x391, '.'}), "A\xE2\x89\xA2\xCE\x91.");  // RFC 3629, section 7
  EXPECT_EQ(utf8Of({0x233b4}), "\xF0\xA3\x8E\xB4");
  EXPECT_EQ(utf8Of(codePointsOf("a\xED\xA0\x80z\xE2\x89")), "a???z??");
}

TEST(Utf8, ABeginningHasNoPartOfACharacter) {
  const std::string text = "a\xe2\x82\xacz";
  const std::vector<std::string> begins{"", "a", "a", "a", "a\xe2\x82\xac", text, text};
  for (std::size_t most = 0; most < begins.size(); ++most) EXPECT_EQ(beginOf(text, most), begins[most]) << most;
  EXPECT_EQ(beginOf("\x82\xac!", 1), "");
}

TEST(Utf8, WhatIsNoneBecomesQuestionMarks) {
  EXPECT_EQ(validUtf8("s\xfc"), "s?");
  EXPECT_EQ(validUtf8("\xc0\x80"), "??");  // overlong
  EXPECT_EQ(validUtf8("\xe2\x82"), "??");  // cut
  EXPECT_EQ(validUtf8("\xe2\x82\xac!"), "\xe2\x82\xac!");
  EXPECT_EQ(validUtf8("\x80z"), "?z");
  EXPECT_TRUE(isUtf8(""));
}

TEST(Utf8, ALineForATerminalHasNoControlCharacters) {
  EXPECT_EQ(printable("a\x1b[31m\r\n\t\x7f.\xc2\x9b\xfc"), "a?[31m????.??");
  EXPECT_EQ(printable("Maße: 3 × 4 µm"), "Maße: 3 × 4 µm");
  EXPECT_EQ(printable(""), "");
  // Those that turn the direction of what follows, or are not seen.
  for (const std::uint32_t point : {0x202aU, 0x202bU, 0x202cU, 0x202dU, 0x202eU, 0x2066U, 0x2067U, 0x2068U, 0x2069U,
                                    0x200eU, 0x200fU, 0x61cU, 0xfeffU, 0x200bU, 0x2028U, 0x2029U, 0x2060U, 0xe0041U})
    EXPECT_EQ(printable("a" + utf8Of({point}) + "b"), "a?b") << point;
  const std::string joined = utf8Of({0x915, 0x94d, 0x200d, 0x937});  // a letter of Devanagari, as it is written
  EXPECT_EQ(printable(joined), joined);
}

}  // namespace
}  // namespace hl::test_utf8
