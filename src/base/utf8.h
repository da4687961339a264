// UTF-8 (RFC 3629): texts of files and of others go into messages, which take nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

/// Overlong forms are none; surrogates and what is beyond 0x10ffff are none either.
bool isUtf8(std::string_view text);
/// `text` with '?' for each byte that belongs to no character of UTF-8.
std::string validUtf8(std::string text);
/// Whether this code point shows nothing of its own, and acts on the text around it: control characters, ends of lines,
/// and the format characters that turn the direction of writing or are invisible. Those that join letters are none.
bool isHidden(std::uint32_t point);
/// The same as validUtf8(), with '?' for each hidden character too: a line for a terminal or a page, whatever names of
/// files and objects hold.
std::string printable(std::string_view text);
/// The beginning of `text`, which is UTF-8: at most so many bytes, and no part of a character at its end.
std::string_view beginOf(std::string_view text, std::size_t most_bytes);
/// The code points of validUtf8(text), and the text of code points that are some.
std::vector<std::uint32_t> codePointsOf(std::string_view text);
std::string utf8Of(const std::vector<std::uint32_t>& points);

}  // namespace hl
