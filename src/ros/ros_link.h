// RosLink: where states of hands go to, and commands for them come from.
#pragma once

#include <cstdint>
#include <optional>

#include "ros/packets.h"

namespace hl {

/// One thread at a time; nothing but wait() and startAgain() waits.
class RosLink {
 public:
  virtual ~RosLink() = default;
  /// Until there is a command, or the link has ended; `most_ns` at most.
  virtual void wait(std::int64_t most_ns) = 0;
  /// False: the other side is behind, and the state is left out.
  virtual bool send(const RosHandState& state) = 0;
  /// The next one that has come.
  virtual std::optional<HandCommand> receive() = 0;
  /// Nothing comes any more, until it has been started again.
  virtual bool ended() const = 0;
  /// After its end; waits. False: it cannot be, now.
  virtual bool startAgain() = 0;
};

}  // namespace hl
