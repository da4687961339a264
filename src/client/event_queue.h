// EventQueue: events wait here until hlPoll, so that callbacks only ever run on the thread that polls.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <deque>

namespace hl::client {

/// Of events that nobody polls the oldest are dropped: this is seconds of them.
inline constexpr std::size_t kMaxEvents = 1024;

class EventQueue {
 public:
  /// Throws Fault HL_INVALID_ENUM.
  void setCallback(HLenum kind, HLeventfunc callback, void* user);
  /// Kept only when its kind has a callback.
  void push(const proto::Event& event);
  /// Calls the callbacks of what is in the queue now, oldest first; returns how many. What a callback throws goes on,
  /// and the events after it stay.
  int deliver();
  bool isDelivering() const { return delivering_; }

 private:
  struct Callback {
    HLeventfunc function = nullptr;
    void* user = nullptr;
  };
  std::array<Callback, 4> callbacks_;  // by HL_EVENT_... - HL_EVENT_TOUCH
  std::deque<HLevent> events_;
  bool delivering_ = false;
};

}  // namespace hl::client
