// ShareLink: how packets go from one server of a shared world to the others.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hl {

/// A server of the world, from its start to its end: a random number above 0.
using ServerId = std::uint64_t;
/// An object of the world, the same number on all servers; above 0.
using ItemId = std::uint64_t;

/// What becomes of a packet that is lost, and who gets it.
enum class Lane : std::uint32_t {
  kItems,   ///< to all, now and later: of a key the last one of each server comes to everybody, also to who joins later
  kStream,  ///< to all that are there: of a key the newest; one that is lost is not sent again
  kInbox,   ///< to the server whose id is the key: all, in order, none lost while both are there
};

struct SharePacket {
  Lane lane = Lane::kStream;
  std::uint64_t key = 0;
  std::string bytes;  ///< a proto::ShareMessage, at most kMaxPacket_bytes
};

/// What DDS sends as one sample with a margin, as a packet of a local socket does.
inline constexpr std::size_t kMaxPacket_bytes = 60'000;

/// One thread at a time; nothing but wait() and startAgain() waits.
class ShareLink {
 public:
  virtual ~ShareLink() = default;
  /// Until there is a packet, or the link has ended; `most_ns` at most.
  virtual void wait(std::int64_t most_ns) = 0;
  /// False: it takes none now. A packet of the stream is to be left out then, any other to be sent again later.
  virtual bool send(const SharePacket& packet) = 0;
  /// The next one that has come, from any server but this one.
  virtual std::optional<SharePacket> receive() = 0;
  /// Nothing comes any more, until it has been started again.
  virtual bool ended() const = 0;
  /// After its end; waits. What was sent before is not known to it. False: it cannot be, now.
  virtual bool startAgain() = 0;
};

}  // namespace hl
