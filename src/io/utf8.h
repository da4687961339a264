// UTF-8 and the code points that it stands for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

/// Each byte that is no part of sound UTF-8 (RFC 3629: no overlong forms, no surrogates) is a question mark.
std::vector<std::uint32_t> codePointsOf(std::string_view text);
/// Of code points up to 0x10ffff.
std::string utf8Of(const std::vector<std::uint32_t>& points);

}  // namespace hl
