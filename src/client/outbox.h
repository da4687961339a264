// Outbox: decides when a flushed frame goes to the server, and remembers which frames have not been answered, and what
// they change: that is taken back when one is refused or dropped.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

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

  using TakeBack = std::function<void(FrameChanges&&)>;

  /// Is called with what a frame has changed that is refused or dropped; what later frames have changed since is not in
  /// it. To be set before the first frame.
  void onTakeBack(TakeBack take_back) { take_back_ = std::move(take_back); }
  /// The frame waits, together with one that waits already. One with nothing in it is not sent, nor refused.
  void add(Draft&& draft) {
    if (!draft.isEmpty()) waiting_.merge(std::move(draft));
  }
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
  std::map<std::uint64_t, FrameChanges> unanswered_;  // by the frame's number
  TakeBack take_back_;
  std::uint64_t last_sent_ = 0;
  std::uint64_t next_upload_ = 1;
  std::int64_t last_sent_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace hl::client
