// TouchSession: a scene, a device and the loops between them.
//
//   ServoLoop       at the servo's rate   device.read -> tick -> stepServo -> device.write: from encoder to motor
//   ProxyThread     at the proxy's rate   finger -> tick -> contacts, while ticks do not fit in a servo step
//                                         (loop_chooser.h)
//   HandMover       60 Hz                 commands and exploration -> the goal of a simulated hand
//   TimerReference  at the servo's rate   nothing but the wait: how punctual this machine is without the servo's work
//
// While several hands are in a world of bodies, HandGroup ticks for all of them instead (hand_group.h). LiveSettings
// are what users change meanwhile, TouchViews what they are shown.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/clock.h"
#include "device/open_device.h"
#include "scene/snapshot.h"
#include "touch/hand_mover.h"
#include "touch/live_settings.h"
#include "touch/loop_exchange.h"
#include "touch/proxy_thread.h"
#include "touch/servo_loop.h"
#include "touch/snapshot_slot.h"
#include "touch/ticker.h"
#include "touch/timer_reference.h"
#include "touch/touch_settings.h"
#include "touch/touch_views.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; started once. Commands: any thread. views(): one thread
/// only.
class TouchSession {
 public:
  /// Takes over an open device. A simulated hand is brought to a place clear of the scene, on a virtual clock; with a
  /// person the proxy starts at the finger, or beside it, outside of what is there.
  TouchSession(std::shared_ptr<const Snapshot> snapshot, const TouchSettings& settings,
               std::unique_ptr<Device> device = openDevice("sim"));
  ~TouchSession();

  void start();
  void stop();  ///< zero force, joins the threads; safe to call twice

  bool hasHand() const { return hand_.hasHand(); }
  /// The simulated hand; commands change nothing when a person holds the device. The session starts and stops it.
  HandMover& hand() { return hand_; }
  const HandMover& hand() const { return hand_; }
  /// What users change while the loops run.
  LiveSettings& live() { return live_; }
  const LiveSettings& live() const { return live_; }
  /// As LiveSettings::actOnBody(), in the world of the bodies, which may be of several hands.
  bool actOnBody(const BodyCommand& command);
  /// In the place of the one before; its times are on the monotonic clock. One thread at a time.
  void pull(const HandPull& pull) { exchange_.pulls.write(pull); }
  /// What a robot far away does to the hand, in the place of the one before; as pull(). readRemote(): the same thread.
  void setRemote(const RemoteInput& input) { exchange_.remotes.write(input); }
  void readRemote(RemotePort& port) { exchange_.remote_ports.read(port); }
  bool makesForce() const { return exchange_.makes_force.load(std::memory_order_relaxed); }

  void views(ServoView& servo, ProxyView& proxy);                             ///< for the pages; one thread only
  void viewsForClients(ServoView& servo, ProxyView& proxy);                   ///< for HL clients; one thread at a time
  bool popSample(TouchSample& sample) { return views_.samples.pop(sample); }  ///< one thread only, as the next
  bool popEvent(TouchEvent& event) { return ticker_.popEvent(event); }
  /// Of several hands at the bodies, the first one reports all.
  bool popEvent(BodyEvent& event);
  /// The last steps, newer ones in the place of older ones. Any thread.
  const LogRing<ServoMoment>& moments() const { return views_.moments; }
  double time_s() const { return time_s(monotonicNow_ns()); }  ///< since the start
  double time_s(std::int64_t monotonic_ns) const { return seconds(monotonic_ns - begin_ns_); }

  /// Shows another scene. Not real-time; one thread at a time, and only when ready().
  void publish(std::shared_ptr<const Snapshot> snapshot) { publish(prepare(std::move(snapshot))); }
  /// As SnapshotSlot::prepare().
  SnapshotSlot::Ready prepare(std::shared_ptr<const Snapshot> snapshot) const;
  void publish(SnapshotSlot::Ready scene) noexcept;
  /// The same of one that is no change of the scene before: it is fitted to the hand.
  void publishAnew(SnapshotSlot::Ready scene) noexcept;
  /// A simulated hand goes above this scene, which is to come, and above the one that is there, and stays there until
  /// hand().free(). Waits for it; false: it is not there after `most_s`, as something holds it. Not real-time.
  bool moveHandAside(const Box& bounds, double most_s);
  /// Whoever ticks has taken the newest scene, and ticked at `since_ns` (monotonic) or later; or nobody does: the loops
  /// do not run, or the servo stands still, without force, and will find the newest scene when it goes on.
  bool ready(std::int64_t since_ns) const;
  /// Frees the scene before the newest one; as publish(), by the same thread.
  void dropSceneBefore();
  std::shared_ptr<const Snapshot> snapshot() const;

  const TouchSettings& settings() const { return settings_; }
  const DeviceLabel& label() const { return settings_.label; }
  const DeviceInfo& deviceInfo() const { return device_->info(); }
  double servoRate_Hz() const { return servo_rate_Hz_; }
  LoopTotals servoTotals() const { return servo_.totals(); }
  /// Of the ticks, wherever they ran; missed and late: of the proxy's thread.
  LoopTotals proxyTotals() const;
  std::uint64_t ticksInServoSteps() const { return ticker_.ticksInServoSteps(); }
  LoopTotals referenceTotals() const { return reference_.totals(); }
  /// What the machine granted to the servo thread; complete once start() has returned.
  const RealtimeGrant& grant() const { return servo_.grant(); }

 private:
  void show(SnapshotSlot::Ready scene) noexcept;
  LoopParts parts() {
    return {*device_, live_, exchange_, ticker_, views_, *sink_, {settings_.faults.get(), settings_.label.number}};
  }

  const TouchSettings settings_;
  const std::unique_ptr<Device> device_;
  const double servo_rate_Hz_;
  mutable std::mutex scenes_mutex_;  // between those who publish and ask; the loops never see it
  SnapshotSlot scenes_;
  LiveSettings live_;
  LoopExchange exchange_;
  TouchViews views_;
  const std::unique_ptr<StepSink> sink_;
  Ticker ticker_;
  ServoLoop servo_;
  ProxyThread proxy_;
  HandMover hand_;
  TimerReference reference_;
  std::int64_t begin_ns_ = 0;
  std::atomic<bool> running_{false};
};

}  // namespace hl
