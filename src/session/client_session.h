// ClientSession: one HL client as the server sees it, whatever carries its messages. Knows no sockets.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <memory>
#include <string>

#include "base/memory_budget.h"

namespace hl {

/// Made by SessionHost::connect. receive(), take() and the destructor are called by one thread at a time, the
/// connection's. When the session is destroyed its objects go, or stay where the client asked for that.
class ClientSession {
 public:
  ClientSession() = default;
  ClientSession(const ClientSession&) = delete;
  ClientSession& operator=(const ClientSession&) = delete;
  virtual ~ClientSession() = default;

  /// What the client has sent; never waits for the device's loops or for a build. After end() is no longer empty it
  /// does nothing.
  virtual void receive(proto::ClientMessage message) = 0;
  /// A message that there is no memory to decode; the outline has only what identifies it: the number of a
  /// frame, the ids of uploads.
  virtual void refuse(const proto::ClientMessage& outline, const std::string& why) = 0;
  /// Against which what carries the session counts what it keeps for it. Any thread.
  virtual MemoryBudget memory() const { return {}; }
  /// Takes the next reply to send; false when there is none now. Answers and events come in order; of states only the
  /// newest, when it is due at the client's rate: a connection that is slow to ask misses states and nothing else.
  virtual bool take(proto::ServerReply& reply) = 0;
  /// Seconds until the next state is due, for the connection's timer; infinity without states. Answers and events come
  /// with a call of `wake` instead.
  virtual double nextState_s() const = 0;
  /// Why the server ends the session, in one line, when the replies before have been taken; empty until then.
  virtual std::string end() const = 0;
};

/// Called by any thread of the server when there is something to take; must return at once, must not call back and
/// throws nothing.
using WakeSession = std::function<void()>;

/// Where connections bring their clients.
class SessionHost {
 public:
  SessionHost() = default;
  SessionHost(const SessionHost&) = delete;
  SessionHost& operator=(const SessionHost&) = delete;
  virtual ~SessionHost() = default;
  /// Any thread. Throws hl::Error when there is no room for another session.
  virtual std::unique_ptr<ClientSession> connect(WakeSession wake) = 0;
};

}  // namespace hl
