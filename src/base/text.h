// Small operations on texts of bytes: they know the letters of ASCII alone, whatever the locale of the process, and
// other bytes stay as they are.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace hl {

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool isLetterOrDigit(char c) { return isLetter(c) || isDigit(c); }
constexpr char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr char raised(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

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
  std::transform(result.begin(), result.end(), result.begin(), [](char c) { return lowered(c); });
  return result;
}

}  // namespace hl
