// Bench session: a simulated device at a scene, one servo step after the other on a virtual clock. What it runs is what
// a session runs: simulated device, TouchStep, proxy.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "scene/snapshot.h"
#include "tools/stability_case.h"
#include "touch/touch_step.h"

namespace hl {

/// The vibration guard is off. Ramp and fade-in are over after kReady_s.
class BenchSession {
 public:
  static constexpr double kRadius_m = 0.002;  ///< of the proxy
  static constexpr double kReady_s = 0.1;

  BenchSession(const StabilityCase& loop, double stiffness_N_m, std::shared_ptr<const Snapshot> scene);

  /// From the next step on.
  void show(std::shared_ptr<const Snapshot> scene) { scenes_.publish(std::move(scene)); }
  void step();
  void steps(double seconds) {
    for (double left_s = seconds; left_s > 0; left_s -= period_s()) step();
  }
  double period_s() const { return settings_.period_s; }
  /// Of the last step, on the hand.
  const Vec3& force_N() const { return force_N_; }
  /// Whether the servo makes force.
  bool on() const { return on_; }
  SimulatedDevice& device() { return device_; }
  const SimulatedDevice& device() const { return device_; }

 private:
  std::int64_t period_ns_;
  SimulatedDevice device_;
  SnapshotSlot scenes_;
  ProxyLoop proxy_;
  ProxyCommands commands_;
  ServoSettings settings_;
  TouchStep step_;
  std::int64_t time_ns_ = 0;
  Vec3 force_N_ = Vec3::Zero();
  bool on_ = true;
};

}  // namespace hl
