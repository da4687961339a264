// EventQueue: events wait here until hlPoll, so that callbacks only ever run on the thread that polls.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace hl::client {

/// Of the hand, since the last motion that was notified: more than it trembles.
inline constexpr double kMotion_m = 0.001;

/// Of events that nobody polls the oldest are dropped: this is seconds of them.
inline constexpr std::size_t kMaxEvents = 1024;

class EventQueue {
 public:
  /// Throws Fault HL_INVALID_ENUM.
  void setCallback(HLenum kind, HLeventfunc callback, void* user);
  /// Kept only when its kind has a callback.
  void push(const proto::Event& event);
  /// The server sends no motions, as its states have them: one is made here when the finger has moved on.
  void pushMotion(const proto::ClientState& state);
  /// Calls the callbacks of what is in the queue now, oldest first; returns how many. What a callback throws goes on,
  /// and the events after it stay.
  int deliver();
  bool isDelivering() const { return delivering_; }

 private:
  struct Callback {
    HLeventfunc function = nullptr;
    void* user = nullptr;
  };
  std::array<Callback, 7> callbacks_;  // by HL_EVENT_... - HL_EVENT_TOUCH
  std::deque<HLevent> events_;
  std::optional<proto::Vec3> notified_;  // the finger, world, at the last motion; none: not since the callback was set
  bool delivering_ = false;
};

}  // namespace hl::client
