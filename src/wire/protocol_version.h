// The version of what a client and a server say to each other (docs/protocol.md).
#pragma once

#include <cstdint>

namespace hl {

/// Must be equal in both.
inline constexpr std::uint32_t kProtocolVersion = 1;

}  // namespace hl
