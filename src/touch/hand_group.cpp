#include "touch/hand_group.h"

#include <utility>

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

HandGroup::HandGroup(std::shared_ptr<const Snapshot> first, double rate_Hz)
    : scenes_(std::move(first)), rate_Hz_(rate_Hz) {}

void HandGroup::join(const LoopParts& parts) { seats_.emplace_back(parts, rate_Hz_); }

void HandGroup::start() {
  thread_.start("hands", [this] { run(); });
}

void HandGroup::stop() { thread_.stop(); }

bool HandGroup::ready(std::int64_t since_ns) const {
  return !thread_.running() || (scenes_.taken() && last_ns_.load(std::memory_order_acquire) >= since_ns);
}

void HandGroup::run() {
  requestRealtime(kProxyPriority, spareCore(1));
  runPeriodic(periodOf_ns(rate_Hz_), thread_.running(), counters_,
              [&](std::int64_t) { guarded([this] { tick(monotonicNow_ns()); }); });
}

void HandGroup::giveCommands(ProxyLoop& hand) {
  BodyCommands commands;
  commands_.takeNext(commands);
  hand.act(commands);
}

// A hand whose device has not given its turn yet is not at the bodies, and its number waits for it. All tick in the
// scene that is here. Without a hand nothing moves: so all steps are in the recordings of the hands.
void HandGroup::tick(std::int64_t now_ns) {
  const Snapshot& scene = scenes_.take();
  FixedVector<HandInStep, kMaxHands> hands;
  bool given = false;  // what clients do to bodies: by the first hand
  for (Seat& seat : seats_) {
    HandInStep hand;
    if (seat.ticker().isTurnOf(Turn::kGroup)) {
      hand = {&seat.ticker().loop(), &seat.begin(now_ns)};
      if (!std::exchange(given, true)) giveCommands(*hand.loop);
    }
    hands.push(hand);
  }
  stepHands(scene, scenes_.bodies(), body_loop_, {hands.begin(), hands.size()});
  for (std::size_t i = 0; i < hands.size(); ++i) {
    if (hands[i].loop != nullptr) seats_[i].end(hands[i].out);
  }
  last_ns_.store(now_ns, std::memory_order_release);
}

}  // namespace hl
