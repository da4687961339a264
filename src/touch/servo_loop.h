// ServoLoop: the thread of the servo, at a fixed rate:
//
//   device.read -> command -> tick, when it is its turn -> stepServo -> device.write -> views, sink
#pragma once

#include <atomic>
#include <cstdint>

#include "base/guarded_thread.h"
#include "base/realtime.h"
#include "touch/device_reader.h"
#include "touch/loop_parts.h"
#include "touch/loop_totals.h"
#include "touch/servo_watch.h"
#include "touch/touch_step.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; started once. The rest: any thread.
class ServoLoop {
 public:
  ServoLoop(const LoopParts& parts, const TouchSettings& settings, double rate_Hz);
  ~ServoLoop() { stop(); }

  /// Reads the device for the first time, so that the other loop knows where the finger is.
  void look();
  /// Returns when the machine has granted what it grants. `begin_ns`: time zero of the samples.
  void start(std::int64_t begin_ns);
  void stop();  ///< zero force, joins the thread; safe to call twice

  LoopTotals totals() const { return totalsOf(counters_); }
  const RealtimeGrant& grant() const { return grant_; }
  /// It stands still, or has and has not noticed yet.
  bool stalled() const { return watch_.stalled(); }
  /// For a loop that stands still, which cannot report it itself.
  void markStall(ServoView& view) const;

 private:
  void run();
  void step();
  ServoCommand commandFor(const DeviceSample& sample);
  bool armsAgain();
  void shareFault();
  ServoOutput touch(const DeviceSample& sample);
  ServoOutput tickAndTouch(const DeviceSample& sample);
  void publish(const ServoRecord& record, std::int64_t begin_ns);

  LoopParts parts_;
  DeviceReader reader_;
  ServoSettings settings_;  // of this step
  const Effects effects_;   // without what pulls the hand
  const bool share_core_;   // with the bare timer
  TouchStep step_;
  LoopMeter meter_;
  TickMessage last_tick_;
  std::uint64_t armed_ = 0;    // requests to arm that have been followed
  std::int64_t begin_ns_ = 0;  // of the session
  LoopCounters counters_;
  ServoWatch watch_;
  RealtimeGrant grant_;
  std::atomic<bool> ready_{false};
  LoopThread thread_;
};

}  // namespace hl
