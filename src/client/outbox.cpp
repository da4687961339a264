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
  if (link.queuedBytes() > kMostQueuedBytes) return Outcome::kTooMuchQueued;
  if (untilAllowed_ns(limits) > 0) return Outcome::kTooEarly;
  Draft draft = withoutUnknown(std::exchange(waiting_, {}));
  if (draft.isEmpty()) return Outcome::kNothingToSend;
  FrameMessages messages = buildMessages(std::move(draft), {last_sent_ + 1, interval_s, limits, next_upload_});
  Known added = takeIn(messages.frame.frame());
  for (proto::ClientMessage& upload : messages.uploads) link.send(std::move(upload));
  link.send(std::move(messages.frame));
  last_sent_ns_ = monotonicNow_ns();
  unanswered_[++last_sent_] = std::move(added);
  return Outcome::kSent;
}

// What was defined and deleted before it could be sent need not be deleted.
Draft Outbox::withoutUnknown(Draft draft) const {
  std::erase_if(draft.deleted_objects, [this](HLuint object) { return !known_.objects.contains(object); });
  std::erase_if(draft.deleted_textures,
                [this](HLuint texture) { return !known_.textures.contains(std::to_string(texture)); });
  return draft;
}

Outbox::Known Outbox::takeIn(const proto::Frame& frame) {
  Known added;
  for (const HLuint object : frame.deleted_objects()) known_.objects.erase(object);
  for (const std::string& texture : frame.deleted_textures()) known_.textures.erase(texture);
  for (const proto::ObjectDefinition& object : frame.objects())
    if (known_.objects.insert(object.id()).second) added.objects.insert(object.id());
  for (const proto::TextureImage& texture : frame.textures())
    if (known_.textures.insert(texture.name()).second) added.textures.insert(texture.name());
  return added;
}

void Outbox::shown(std::uint64_t number) { unanswered_.erase(unanswered_.begin(), unanswered_.upper_bound(number)); }

void Outbox::refused(std::uint64_t number) {
  const auto found = unanswered_.find(number);
  if (found == unanswered_.end()) return;
  for (const HLuint object : found->second.objects) known_.objects.erase(object);
  for (const std::string& texture : found->second.textures) known_.textures.erase(texture);
  unanswered_.erase(found);
}

}  // namespace hl::client
