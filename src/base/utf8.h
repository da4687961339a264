// UTF-8: texts of files and of others go into messages, which take nothing else.
#pragma once

#include <string>
#include <string_view>

namespace hl {

/// Overlong forms are none; surrogates and what is beyond 0x10ffff are none either.
bool isUtf8(std::string_view text);
/// `text` with '?' for each byte that belongs to no character of UTF-8.
std::string validUtf8(std::string text);

}  // namespace hl
