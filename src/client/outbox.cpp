#include "client/outbox.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "client/frame_messages.h"

namespace hl::client {

std::int64_t Outbox::untilAllowed_ns(const proto::Limits& limits) const {
  if (last_sent_ == 0 || !(limits.frames_hz() > 0)) return 0;
  const auto gap = static_cast<std::int64_t>(1e9 / limits.frames_hz());
  return std::max<std::int64_t>(0, last_sent_ns_ + gap - monotonicNow_ns());
}

Outbox::Outcome Outbox::trySend(Link& link, const proto::Limits& limits, std::optional<double> interval_s) {
  if (!hasWaiting()) return Outcome::kNothingToSend;
  if (link.queuedBytes() > kMaxQueuedBytes) return Outcome::kTooMuchQueued;
  if (untilAllowed_ns(limits) > 0 || unanswered_.size() >= kMaxUnanswered) return Outcome::kTooEarly;
  Draft draft = std::exchange(waiting_, {});
  FrameChanges changes = std::exchange(draft.changes, {});
  try {
    FrameMessages messages = buildMessages(std::move(draft), {last_sent_ + 1, interval_s, limits, next_upload_});
    for (proto::ClientMessage& upload : messages.uploads) link.send(std::move(upload));
    link.send(std::move(messages.frame));
  } catch (...) {
    take_back_(std::move(changes));
    throw;
  }
  last_sent_ns_ = monotonicNow_ns();
  unanswered_.emplace(++last_sent_, std::move(changes));
  return Outcome::kSent;
}

void Outbox::shown(std::uint64_t number) { unanswered_.erase(unanswered_.begin(), unanswered_.upper_bound(number)); }

void Outbox::refused(std::uint64_t number) {
  const auto found = unanswered_.find(number);
  if (found == unanswered_.end()) return;
  FrameChanges changes = std::move(found->second);
  for (auto later = unanswered_.erase(found); later != unanswered_.end(); ++later) later->second.inheritFrom(changes);
  waiting_.changes.inheritFrom(changes);
  take_back_(std::move(changes));
}

}  // namespace hl::client
