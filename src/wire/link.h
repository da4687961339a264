// Link: a client's end of the conversation with a server, whatever carries it (a WebSocket, or a server in the same
// process): whole messages of proto/hl.proto, in order, both ways.
#pragma once

#include <hl.pb.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace hl {

/// Used by one thread, but for the destructor's own threads inside.
class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;  ///< ends the conversation; what was sent before is still delivered where that is possible

  /// Queues a message; never waits for the network. After the link has ended it does nothing.
  virtual void send(proto::ClientMessage message) = 0;
  /// Bytes that were sent and are not yet with the server: whoever sends much should look at it.
  virtual std::size_t queuedBytes() const = 0;
  /// Takes the next reply that has arrived; false when there is none. Of states that were not taken only the newest is
  /// kept, in its place.
  virtual bool take(proto::ServerReply& reply) = 0;
  /// Waits until there is a reply to take or the link has ended, but not longer. Returns whether there is a reply.
  virtual bool wait(std::chrono::nanoseconds longest) = 0;
  /// Why the link has ended, in one line; empty while it lives.
  virtual std::string ended() const = 0;
};

}  // namespace hl
