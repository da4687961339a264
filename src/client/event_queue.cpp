#include "client/event_queue.h"

#include <cmath>

#include "base/flag.h"
#include "client/fault.h"

namespace hl::client {

namespace {

HLevent eventOf(const proto::Event& in) {
  HLevent event{};
  event.kind = HL_EVENT_TOUCH + static_cast<HLenum>(in.kind());  // both count from TOUCH
  event.time = in.time_s();
  event.object = in.object();
  event.name = in.name();
  event.position[0] = in.position().x();
  event.position[1] = in.position().y();
  event.position[2] = in.position().z();
  event.button = in.button();
  event.down = in.down() ? HL_TRUE : HL_FALSE;
  event.impulse = in.impulse_n_s();
  return event;
}

double distanceOf(const proto::Vec3& a, const proto::Vec3& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y(), a.z() - b.z());
}

}  // namespace

void EventQueue::setCallback(HLenum kind, HLeventfunc callback, void* user) {
  if (kind < HL_EVENT_TOUCH || kind > HL_EVENT_IMPACT) throw Fault(HL_INVALID_ENUM, "the kind must be HL_EVENT_...");
  callbacks_[kind - HL_EVENT_TOUCH] = {callback, user};
  if (kind == HL_EVENT_MOTION) notified_.reset();
}

void EventQueue::push(const proto::Event& event) {
  const auto kind = static_cast<std::size_t>(event.kind());
  if (kind >= callbacks_.size() || callbacks_[kind].function == nullptr) return;
  if (events_.size() == kMaxEvents) events_.pop_front();
  events_.push_back(eventOf(event));
}

void EventQueue::pushMotion(const proto::ClientState& state) {
  if (callbacks_[proto::MOTION].function == nullptr) return;
  const bool is_first = !notified_;
  if (!is_first && distanceOf(state.finger(), *notified_) < kMotion_m * state.workspace().world_per_device()) return;
  notified_ = state.finger();
  if (is_first) return;
  proto::Event event;
  event.set_kind(proto::MOTION);
  event.set_time_s(state.time_s());
  *event.mutable_position() = state.proxy();
  push(event);
}

int EventQueue::deliver() {
  if (delivering_) throw Fault(HL_INVALID_OPERATION, "not in a callback of hlPoll");
  const Flag delivering(delivering_);
  int delivered = 0;
  // Only as many as there are now: a callback that takes replies must not keep this going for ever.
  for (std::size_t left = events_.size(); left > 0 && !events_.empty(); --left) {
    const HLevent event = events_.front();
    events_.pop_front();
    const Callback callback = callbacks_[event.kind - HL_EVENT_TOUCH];
    if (callback.function == nullptr) continue;
    callback.function(&event, callback.user);
    ++delivered;
  }
  return delivered;
}

}  // namespace hl::client
