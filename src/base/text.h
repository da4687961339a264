// Small operations on texts of bytes: they change ASCII alone, and other bytes stay as they are.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace hl {

/// Without the letters of `around` at its ends: blanks, tabs and carriage returns.
inline std::string_view trimmed(std::string_view text, std::string_view around = " \t\r") {
  const std::size_t first = text.find_first_not_of(around);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(around) - first + 1);
}

/// Without the byte order mark of UTF-8, with which some editors begin a text.
inline std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

/// Without any of these letters.
inline std::string without(std::string_view letters, std::string_view text) {
  std::string result(text);
  std::erase_if(result, [&](char c) { return letters.find(c) != std::string_view::npos; });
  return result;
}

/// In lower case.
inline std::string lowered(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

}  // namespace hl
