// Traffic: what has gone through the sockets, for /metrics. Written and read by the server's thread alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "monitor/metrics_text.h"

namespace hl {

enum class RefusedBecause : std::uint8_t {
  kAccess,     ///< foreign Host or Origin, wrong token
  kMalformed,  ///< does not parse, or not what comes next
  kTooLarge,
  kTooFast,
  kSilent,     ///< no request or Open in time, reads nothing, or answers no ping
  kFull,       ///< no room for another page or session
  kFailed,     ///< our own fault
  kHandshake,  ///< no TLS handshake, or none in time
};
inline constexpr std::size_t kRefusedReasons = 8;
inline constexpr std::array<const char*, kRefusedReasons> kRefusedNames{
    "access", "malformed", "too_large", "too_fast", "silent", "full", "failed", "handshake"};

/// What became of a file that a page sent.
enum class UploadResult : std::uint8_t {
  kOpened,
  kDenied,     ///< foreign Host or Origin, no token
  kNotTaken,   ///< this server takes none
  kMalformed,  ///< no POST, no name, empty
  kTooLarge,
  kBusy,  ///< with the one before
  kSlow,
  kCut,         ///< the connection ended half-way
  kUnreadable,  ///< its reader refused it
  kFailed,      ///< our own fault
};
inline constexpr std::size_t kUploadResults = 10;
inline constexpr std::array<const char*, kUploadResults> kUploadResultNames{
    "opened", "denied", "not_taken", "malformed", "too_large", "busy", "slow", "cut", "unreadable", "failed"};

struct Traffic {
  std::uint64_t sessions = 0;         ///< HL clients now
  std::uint64_t sessions_opened = 0;  ///< since the start, as all below
  std::uint64_t messages_in = 0, messages_out = 0;
  std::uint64_t bytes_in = 0, bytes_out = 0;  ///< of WebSocket messages, without framing and TLS
  std::array<std::uint64_t, kRefusedReasons> refused{};
  std::array<std::uint64_t, kUploadResults> uploads{};
  std::uint64_t upload_bytes = 0;  ///< of files, as far as they came

  void count(UploadResult result) { ++uploads[static_cast<std::size_t>(result)]; }
  void refuse(RefusedBecause reason) { ++refused[static_cast<std::size_t>(reason)]; }
};

/// With what the sockets' owners count themselves.
struct ServerCounts {
  Traffic traffic;
  std::size_t connections = 0, pages = 0;  ///< now
  std::size_t crowded_out = 0;             ///< connections closed for want of room, since the start
};

void writeTraffic(MetricsText& out, const ServerCounts& counts);

}  // namespace hl
