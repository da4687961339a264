#include "touch/hand_group.h"

#include <utility>

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

HandGroup::HandGroup(std::shared_ptr<const Snapshot> first, double rate_Hz)
    : scenes_(std::move(first)), rate_Hz_(rate_Hz) {}

void HandGroup::join(const LoopParts& parts) { seats_.push_back({TickBeside(parts, rate_Hz_)}); }

void HandGroup::start() {
  running_ = true;
  thread_ = startThread("hands", [this] { run(); });
}

void HandGroup::stop() {
  if (running_.exchange(false)) thread_.join();
}

bool HandGroup::ready(std::int64_t since_ns) const {
  return !running_ || (scenes_.taken() && last_ns_.load(std::memory_order_acquire) >= since_ns);
}

void HandGroup::run() {
  requestRealtime(kProxyPriority, spareCore(1));
  runPeriodic(periodOf_ns(rate_Hz_), running_, counters_,
              [&](std::int64_t) { guarded([this] { tick(monotonicNow_ns()); }); });
}

// A hand whose device has not given its turn yet is not at the bodies, and its number waits for it.
void HandGroup::tick(std::int64_t now_ns) {
  const Snapshot& scene = scenes_.take();
  FixedVector<HandAtBodies, kMostHands> hands;
  for (Seat& seat : seats_) {
    seat.ticks = seat.tick.ticker().isTurnOf(Turn::kGroup);
    HandAtBodies hand;
    if (seat.ticks) {
      const TickRequest& request = seat.tick.begin(now_ns);
      hand = seat.tick.ticker().loop().begin(now_ns, request.finger_D, request.commands, request.spring);
    }
    hands.push(hand);
  }
  BodyCommands commands;
  commands_.takeNext(commands);
  body_loop_.act(commands);
  body_loop_.step(scene, scenes_.bodies(), now_ns, 1 / rate_Hz_, {hands.begin(), hands.size()});
  for (std::size_t number = 0; number < hands.size(); ++number) {
    Seat& seat = seats_[number];
    if (seat.ticks) seat.tick.end(seat.tick.ticker().loop().end(scenes_.bodies(), number));
  }
  last_ns_.store(now_ns, std::memory_order_release);
}

}  // namespace hl
