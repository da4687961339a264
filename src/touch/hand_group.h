// HandGroup: the hands of several devices at one world of bodies. One loop moves a body, so while a scene has bodies
// that move, one thread makes the ticks of all hands:
//
//   each hand: newest finger, scene and settings -> step the bodies, all hands among them -> each hand: tick, settle
//
// The servo of each device goes on at its own rate, and so does the world when a device stands still.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/guarded_thread.h"
#include "touch/hands_step.h"
#include "touch/loop_parts.h"
#include "touch/loop_totals.h"
#include "touch/snapshot_slot.h"
#include "touch/tick_beside.h"

namespace hl {

/// Constructed, joined, started, stopped and destroyed by one thread; started once. Scenes: by one publisher.
class HandGroup {
 public:
  /// `rate_Hz`: of the ticks. Throws hl::Error where the bodies of the scene cannot be made.
  HandGroup(std::shared_ptr<const Snapshot> first, double rate_Hz);
  ~HandGroup() { stop(); }

  /// The next hand, before start(). `parts` outlive the loop. Of more than kMaxHands none is at the bodies; then no
  /// scene may have any that move.
  void join(const LoopParts& parts);
  void start();
  void stop();  ///< safe to call twice
  /// One turn of the loop, which makes them between start() and stop(). RT-safe.
  void tick(std::int64_t now_ns);

  /// Shows another scene; after the devices do, which are never in one that is older.
  void publish(SnapshotSlot::Ready scene) noexcept { scenes_.publish(std::move(scene)); }
  void dropSceneBefore() { scenes_.dropBefore(); }
  /// The loop has taken the newest scene, and ticked at `since_ns` (monotonic) or later; or it does not run.
  bool ready(std::int64_t since_ns) const;

  /// False: too many wait. Any thread.
  bool actOnBody(const BodyCommand& command) { return commands_.push(command); }
  bool popEvent(BodyEvent& event) { return body_loop_.pop(event); }  ///< one thread only
  LoopTotals totals() const { return totalsOf(counters_); }          ///< any thread

 private:
  using Seat = TickBeside;
  void run();
  void giveCommands(ProxyLoop& hand);

  SnapshotSlot scenes_;
  const double rate_Hz_;
  std::vector<Seat> seats_;
  BodyCommandQueue commands_;
  BodyLoop body_loop_;
  std::atomic<std::int64_t> last_ns_{0};
  LoopCounters counters_;
  LoopThread thread_;
};

}  // namespace hl
