// WebSession: a scene, the simulated device and its hand, the servo and its ticks, on one thread and a virtual clock.
#pragma once

#include <memory>

#include "device/simulated_device.h"
#include "hl_web.h"
#include "scene/iso_shape.h"
#include "sent_scene.h"
#include "touch/ending_counts.h"
#include "touch/exploration.h"
#include "touch/snapshot_slot.h"
#include "touch/touch_step.h"

namespace hl {

class WebSession {
 public:
  explicit WebSession(std::shared_ptr<const Snapshot> snapshot);

  void step(int steps);
  void setGoal(const Vec3& goal_W);
  void release();
  void press(std::uint32_t buttons) { device_.setHandButtons(buttons); }
  void turn(const Eigen::Quaterniond& turned) { device_.setHandTurn(turned); }
  void rearm() { arm(step_.servo()); }
  void setExplore(bool on);
  void setFirm(bool firm);
  void setStiffness(double stiffness_N_m);
  /// Another surface of the volume of this number. Throws hl::Error, and changes nothing, for a value that is none.
  void setIso(int volume, const IsoChoice& choice);
  void setLedger(LedgerMode mode) { settings_.ledger = mode; }
  MaterialOverride& surfaces() { return commands_.surfaces; }

  const HlWebScene& scene() const { return scene_; }
  const HlWebState& state();
  const char* fault() const { return faultText(out_.fault); }
  SentScene& sent() { return sent_; }
  std::int64_t now_ns() const { return now_ns_; }

 private:
  void bringToStart();
  void oneStep();
  void moveHand();
  void describeScene();
  void describeTouch();
  void describeEnergy();
  void describeBodies();
  Vec3 clamped(const Vec3& goal_D) const;

  std::shared_ptr<const Snapshot> snapshot_;
  SentScene sent_;
  SimulatedDevice device_;
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  TouchStep step_;
  ServoSettings settings_;
  ServoOutput out_;
  DeviceSample sample_;
  ProxyCommands commands_;
  EndingCounts endings_;
  Exploration exploration_;
  std::int64_t now_ns_ = 0, begin_ns_ = 0, period_ns_;
  std::uint64_t steps_ = 0;
  bool exploring_ = false, firm_ = false;
  HlWebScene scene_{};
  HlWebState state_{};
};

}  // namespace hl
