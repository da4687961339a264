// What a message of a client takes in memory, by its bytes alone: it may be many times what it was on the wire, so it
// is counted before it is decoded.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <string_view>

namespace hl {

/// Of a ClientMessage in its binary form, while it is decoded: at least what that takes. One that does not parse is
/// counted as far as it does.
std::uint64_t bytesToDecode(std::string_view wire);

/// Memory that a message takes, with malloc()'s own; `counted` is its SpaceUsedLong().
inline std::uint64_t bytesOfMessage(std::uint64_t counted) { return counted + counted / 4; }

/// What identifies the message, from its bytes or the first of them: the number of a frame, the ids of the first
/// uploads.
proto::ClientMessage outlineOf(std::string_view wire);

}  // namespace hl
