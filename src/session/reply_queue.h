// ReplyQueue: what a session has to send to its client, until the connection takes it.
#pragma once

#include <hl.pb.h>

#include <deque>
#include <mutex>
#include <string>

#include "base/memory_budget.h"
#include "session/client_session.h"

namespace hl {

/// Any thread.
class ReplyQueue {
 public:
  /// What waits is counted against `memory`.
  ReplyQueue(const MemoryBudget& memory, WakeSession wake) : memory_(memory), wake_(std::move(wake)) {}

  /// Where there is no memory for it, or the client reads nothing, the session ends.
  void push(proto::ServerReply reply);
  /// How much of a frame is built. Of progress that nobody has read yet the newest is enough. Of a frame that is built
  /// immediately, or where there is no memory, none is sent.
  void pushProgress(std::uint64_t frame, double built);
  /// False when nothing waits.
  bool take(proto::ServerReply& reply);

  /// Ends the session with this reason; the first counts.
  void end(const std::string& why);
  /// Why it ends; empty until it does.
  std::string end() const;

 private:
  struct Waiting {
    proto::ServerReply reply;
    MemoryShare memory;
  };

  Waiting counted(proto::ServerReply reply) const;
  void add(Waiting waiting);  // holding mutex_

  const MemoryBudget memory_;
  const WakeSession wake_;
  mutable std::mutex mutex_;  // of what follows
  std::deque<Waiting> waiting_;
  std::string end_;
};

}  // namespace hl
