// UTF-8 (RFC 3629): texts of files and of others go into messages, which take nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

/// Overlong forms are none; surrogates and what is beyond 0x10ffff are none either.
bool isUtf8(std::string_view text);
/// `text` with '?' for each byte that belongs to no character of UTF-8.
std::string validUtf8(std::string text);
/// The code points of validUtf8(text), and the text of code points that are some.
std::vector<std::uint32_t> codePointsOf(std::string_view text);
std::string utf8Of(const std::vector<std::uint32_t>& points);

}  // namespace hl
