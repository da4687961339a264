// Base64 (RFC 4648), in which data URIs hold bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hl {

std::string toBase64(std::string_view bytes);
/// Nothing for a text that is not base64. Signs '=' at the end may be missing.
std::optional<std::string> fromBase64(std::string_view text);

}  // namespace hl
