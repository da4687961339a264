// Ticker: the ticks, by whichever of the loops makes them: their input, and who gets their results.
#pragma once

#include <atomic>
#include <cstdint>

#include "touch/live_settings.h"
#include "touch/loop_chooser.h"
#include "touch/loop_exchange.h"
#include "touch/loop_meter.h"
#include "touch/proxy_loop.h"
#include "touch/snapshot_slot.h"
#include "touch/step_sink.h"
#include "touch/touch_views.h"

namespace hl {

/// All that it is made with must outlive it. follow(), loop() and done(): by the loop whose turn it is; RT-safe. The
/// counts: any thread.
class Ticker {
 public:
  /// `grouped`: another loop ticks for it where a scene has bodies (hand_group.h).
  Ticker(SnapshotSlot& scenes, LiveSettings& live, LoopExchange& exchange, TouchViews& views, StepSink& sink,
         std::int64_t servo_period_ns, bool grouped);

  /// Whether the loop that asks is to tick now. The turn may go to another one in this call.
  bool isTurnOf(Turn who);
  /// What the next tick is to follow.
  const ProxyCommands& follow();
  ProxyLoop& loop() { return loop_; }
  /// A tick has been made; `step` is null where the device gave no reading to make it with. At last the turn may go to
  /// the other loop.
  void done(const TickRequest& request, const ProxyStep* step, std::int64_t begin_ns, std::int64_t work_ns);

  /// One thread only, the same for both kinds.
  bool popEvent(TouchEvent& event) { return loop_.popEvent(event); }
  bool popEvent(BodyEvent& event) { return loop_.popEvent(event); }
  std::uint64_t ticks() const { return ticks_.load(); }
  std::uint64_t ticksInServoSteps() const { return ticks_in_servo_steps_.load(); }
  std::int64_t last_ns() const { return last_ns_.load(std::memory_order_acquire); }  ///< when the last one began

 private:
  void show(const ProxyStep* step);

  LiveSettings& live_;
  LoopExchange& exchange_;
  TouchViews& views_;
  StepSink& sink_;
  ProxyLoop loop_;
  LoopChooser chooser_;
  const bool grouped_;
  // Of the loop that ticks; they go from one to the other with its turn.
  ProxyCommands commands_;
  BodyCommands on_bodies_;
  ProxyView view_;
  LoopMeter meter_;

  std::atomic<std::int64_t> last_ns_{0};
  std::atomic<std::uint64_t> ticks_{0}, ticks_in_servo_steps_{0};
};

}  // namespace hl
