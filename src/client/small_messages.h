// SmallMessages: what a client tells the server beside its frames: settings, requests, and commands to bodies. A server
// ends a session that sends too many messages, so of these only kSmallMessages_Hz go at once, with bursts of one
// second's worth. Others wait: of settings and requests the newest, and all commands, together in one message.
#pragma once

#include <hl.pb.h>

#include <cstddef>
#include <map>

#include "session/message_rate.h"
#include "wire/link.h"

namespace hl::client {

/// Half of what a server takes from a session; frames and uploads have the rest.
inline constexpr double kSmallMessages_Hz = 1000;
/// Commands to bodies that may wait; more are refused.
inline constexpr int kMaxWaitingCommands = 4096;

class SmallMessages {
 public:
  /// Sends the message now, or together with others by a later sendWaiting(). Throws Fault HL_BUSY when too many
  /// commands wait; this one is not sent.
  void send(Link& link, proto::ClientMessage&& message);
  void sendWaiting(Link& link);
  bool empty() const { return waiting_.empty() && commands_.commands().empty(); }

 private:
  void sendCommands(Link& link);

  std::map<proto::ClientMessage::BodyCase, proto::ClientMessage> waiting_;
  proto::BodyCommands commands_;
  MessageRate rate_{kSmallMessages_Hz};
};

}  // namespace hl::client
