// Outbox: decides when a flushed frame goes to the server, and remembers which frames have not been answered.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

#include "client/draft.h"
#include "wire/link.h"

namespace hl::client {

/// With more than this on its way to the server the next frame waits: a slow network must not fill the memory.
inline constexpr std::size_t kMaxQueuedBytes = std::size_t{16} << 20;

/// With so many frames unanswered the next one waits: the server is still building them, and shows what is newest
/// sooner when it has not to build all between. At 60 frames a second this covers a network of a quarter of a second.
inline constexpr std::size_t kMaxUnanswered = 16;

class Outbox {
 public:
  enum class Outcome { kNothingToSend, kSent, kTooMuchQueued, kTooEarly };

  /// The frame waits, together with one that waits already.
  void add(Draft&& draft) { waiting_.merge(std::move(draft)); }
  bool hasWaiting() const { return !waiting_.isEmpty(); }
  /// Sends what waits, if this is the moment. Throws Fault HL_OUT_OF_MEMORY and drops it when it is too large.
  Outcome trySend(Link& link, const proto::Limits& limits, std::optional<double> interval_s);
  /// Nanoseconds until the server's frame rate allows the next frame; 0: now.
  std::int64_t untilAllowed_ns(const proto::Limits& limits) const;

  /// The server shows frame `number`: it and those before it are answered.
  void shown(std::uint64_t number);
  /// Frame `number` changed nothing at the server.
  void refused(std::uint64_t number);

  std::uint64_t lastSent() const { return last_sent_; }
  bool allAnswered() const { return unanswered_.empty(); }

 private:
  Draft waiting_;
  std::set<std::uint64_t> unanswered_;  // frames
  std::uint64_t last_sent_ = 0;
  std::uint64_t next_upload_ = 1;
  std::int64_t last_sent_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace hl::client
