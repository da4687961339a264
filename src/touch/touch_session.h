// TouchSession: a scene, a device and the two real-time loops between them.
//
//   servo loop  (fixed rate): device.read -> tick -> stepServo -> device.write   the path from encoder to motor
//   proxy loop  (fixed rate): finger -> tick -> contacts    only while ticks do not fit in a servo step (tick_place.h)
//   supervisor  (60 Hz):      commands and exploration -> the hand's goal
// Each datum has one writer; they meet only through Latest.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/latest.h"
#include "base/log_ring.h"
#include "base/periodic.h"
#include "base/realtime.h"
#include "base/spsc_ring.h"
#include "control/servo_options.h"
#include "device/hand_script.h"
#include "device/open_device.h"
#include "device/simulated_hand.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"
#include "touch/ending_counts.h"
#include "touch/exploration.h"
#include "touch/loop_chooser.h"
#include "touch/loop_meter.h"
#include "touch/proxy_loop.h"
#include "touch/servo_rate.h"
#include "touch/servo_watch.h"
#include "touch/snapshot_slot.h"
#include "touch/step_sink.h"
#include "touch/touch_step.h"
#include "touch/workspace.h"

namespace hl {

struct TouchSettings {
  double radius_D = 0.002;  ///< m, proxy radius at the hand
  double side_D = 0.12;  ///< m, largest side of the model at the hand, unless scale is given; at most what the device
                         ///< reaches
  std::optional<double> world_per_device;
  ServoRate servo_rate{};
  double proxy_rate_Hz = 1000;          ///< while ticks do not fit in a servo step
  std::optional<double> stiffness_N_m;  ///< K; the device's own when not given
  std::optional<double> damping_Ns_m;   ///< B
  ServoOptions servo{};
  MakeStepSink sink;       ///< of all that the loops do; empty: none
  bool hand_firm = false;  ///< of a simulated hand, as the next two
  bool explore = true;
  std::optional<HandScript> script;  ///< hand goals in the world frame instead of exploration
  MaterialOverride surfaces{};       ///< over what the scene says
  LedgerMode ledger = LedgerMode::kTank;
  bool timer_reference = false;  ///< run a bare timer thread on the servo's core, to tell the machine's own hiccups
};

/// What the last tick did. World frame.
struct ProxyView {
  Vec3 proxy = Vec3::Zero();
  FixedVector<ProxyContact, 3> contacts;
  FixedVector<ObjectName, 3> touched;  ///< of the contacts, one by one
  bool slipping = false;
  Ledger ledger;
  EndingCounts ended;  ///< ticks so far, by why they ended
  LoopSummary loop;
};

/// What the vibration guard has done.
struct VibrationView {
  double limit_N_m = 0;      ///< the spring is held below it; 0: there is no limit
  std::uint64_t alarms = 0;  ///< how often it has softened the spring since the start
  double dissipated_J = 0;   ///< what it has taken out of the spring and the hand
};

/// What the servo loop last did.
struct ServoView {
  std::uint32_t buttons = 0;  ///< of the device, bit i: button i is down
  Vec3 finger_D = Vec3::Zero();
  Vec3 force_N = Vec3::Zero();
  SafetyState safety = SafetyState::kOff;
  FaultReason fault{};
  Ledger late{};  ///< of the hand-over from proxy to servo
  VibrationView vibration{};
  LoopSummary loop;
};

/// One servo step for the plots.
struct TouchSample {
  double time_s = 0;
  float force_N = 0;
  float penetration_m = 0;  ///< |target - finger| at the hand
  float tick_us = 0;        ///< work time of the newest tick
};

/// One servo step, for clients. Frame D.
struct ServoMoment {
  std::int64_t time_ns = 0;  ///< monotonic
  Vec3 finger_D = Vec3::Zero();
  Vec3 force_N = Vec3::Zero();
  std::uint64_t buttons = 0;
};

/// See LoopCounters.
struct LoopTotals {
  std::uint64_t steps = 0, missed = 0;
  std::int64_t late_max_ns = 0;
  std::array<std::uint64_t, kDutyBounds.size() + 1> duty{};
  std::uint64_t page_faults = 0, waits = 0, preempted = 0;
};

/// Constructed, started, stopped and destroyed by one thread. Commands: any thread. views(): one thread only.
class TouchSession {
 public:
  /// Takes over an open device. A simulated hand is brought to a place clear of the scene, on a virtual clock; with a
  /// person the proxy starts at the finger, or beside it, outside of what is there.
  TouchSession(std::shared_ptr<const Snapshot> snapshot, const TouchSettings& settings,
               std::unique_ptr<Device> device = openDevice("sim"));
  ~TouchSession();

  void start();
  void stop();  ///< zero force, joins the threads; safe to call twice

  // Of a simulated hand; they change nothing when a person holds the device.
  bool hasHand() const { return hand_ != nullptr; }
  void setHandGoal(const Vec3& goal_W);  ///< a person takes over from the exploration
  void release();
  /// Bit i: button i of the device is down, for a second from now: a page that has gone presses nothing.
  void press(std::uint32_t buttons);
  void setExplore(bool on);
  void setHandFirm(bool firm);

  void setStiffness(double stiffness_N_m);             ///< clamped to what the device accepts
  void setSurfaces(const MaterialOverride& surfaces);  ///< replaces what was set before; numbers out of range are cut
  void setLedger(LedgerMode mode);
  void rearm();

  void views(ServoView& servo, ProxyView& proxy);            ///< for the pages; one thread only
  void viewsForClients(ServoView& servo, ProxyView& proxy);  ///< for HL clients; one thread at a time
  bool popSample(TouchSample& sample) { return samples_.pop(sample); }
  /// The last steps, newer ones in the place of older ones. Any thread.
  const LogRing<ServoMoment>& moments() const { return moments_; }
  bool exploring() const { return exploring_.load(); }
  bool handFirm() const { return hand_firm_.load(); }
  double stiffness_N_m() const { return stiffness_.load(); }
  MaterialOverride surfaces() const;
  LedgerMode ledger() const { return ledger_.load(); }
  double time_s() const { return time_s(monotonicNow_ns()); }  ///< since the start
  double time_s(std::int64_t monotonic_ns) const { return 1e-9 * static_cast<double>(monotonic_ns - start_ns_); }

  /// Shows another scene. Not real-time; one thread at a time, and only when ready().
  void publish(std::shared_ptr<const Snapshot> snapshot);
  /// Whoever ticks has taken the newest scene, and ticked at `since_ns` (monotonic) or later; or nobody does: the loops
  /// do not run, or the servo stands still, without force, and will find the newest scene when it goes on.
  bool ready(std::int64_t since_ns) const;
  /// Frees the scene before the newest one; as publish(), by the same thread.
  void dropSceneBefore();
  bool popEvent(TouchEvent& event) { return proxy_loop_.popEvent(event); }  ///< one thread only
  void setWorkspace(const Workspace& workspace);
  void setRadius(double radius_W);

  std::shared_ptr<const Snapshot> snapshot() const;
  Workspace workspace() const;
  const TouchSettings& settings() const { return settings_; }
  const DeviceInfo& deviceInfo() const { return device_->info(); }
  double servoRate_Hz() const { return servo_rate_Hz_; }
  double radius_W() const;
  LoopTotals servoTotals() const { return totals(servo_counters_); }
  /// Of the ticks, wherever they ran; missed and late: of the proxy loop.
  LoopTotals proxyTotals() const;
  std::uint64_t ticksInServoSteps() const { return ticks_in_servo_steps_.load(); }
  LoopTotals referenceTotals() const { return totals(reference_counters_); }
  /// What the machine granted to the servo thread; complete once start() has returned.
  const RealtimeGrant& grant() const { return grant_; }

 private:
  struct TickMessage {
    HeldContacts held;
    float work_us = 0;
  };
  // Of the loop that ticks; goes from one to the other with its turn.
  struct Ticking {
    ProxyCommands commands;
    ProxyView view;
    LoopMeter meter;

    const ProxyCommands& follow(TouchSession& session);
  };
  struct Commands {
    std::optional<Vec3> goal_W;
    bool release = false;
    std::optional<bool> explore;
    std::optional<std::uint32_t> buttons;
  };

  static LoopTotals totals(const LoopCounters& counters);
  void tellStall(ServoView& servo) const;
  void bringHandToStart();
  void startAt(const DeviceSample& sample);
  void runServo();
  DeviceSample readDevice(std::int64_t now_ns) noexcept;
  void runReference();
  ServoOutput touchNow(TouchStep& step, const ServoSettings& settings, const DeviceSample& sample, TickMessage& last);
  void runProxy();
  void show(const ProxyStep& step, std::int64_t now_ns, std::int64_t work_ns);
  void runSupervisor();
  Commands takeCommands();
  void moveHand(const Commands& commands);
  std::optional<Vec3> strokingGoal() const;
  Vec3 clampToWorkspace(const Vec3& goal_D) const;
  void restartWith(const Workspace& workspace, double radius_W);  // holding settings_mutex_

  TouchSettings settings_;
  std::unique_ptr<Device> device_;
  const double servo_rate_Hz_;
  SimulatedHand* hand_;       // of the device; null when a person holds it
  bool answered_ = false;     // the device did when it was read last; of the servo thread, once it runs, as the next
  bool step_failed_ = false;  // the step before threw something: its device is taken for lost
  SnapshotSlot scenes_;
  ProxyLoop proxy_loop_;
  TickPlace place_;
  Ticking ticking_;
  ServoSettings servo_settings_;
  std::int64_t start_ns_ = 0;

  Latest<Vec3> finger_D_{Vec3::Zero()};
  Latest<Vec3> finger_for_supervisor_D_{Vec3::Zero()};
  Latest<TickMessage> ticks_{TickMessage{}};  // of the proxy loop
  Latest<ServoView> servo_view_{ServoView{}}, servo_for_clients_{ServoView{}};
  Latest<ProxyView> proxy_view_{ProxyView{}}, proxy_for_clients_{ProxyView{}};
  SpscRing<TouchSample, 1024> samples_;
  LogRing<ServoMoment> moments_{1024};

  std::atomic<bool> running_{false};
  std::atomic<bool> exploring_{false};
  std::atomic<bool> hand_firm_{false};
  std::atomic<double> stiffness_{0};
  std::atomic<bool> makes_force_{false};  // as of the servo's last step
  std::atomic<std::int64_t> last_tick_ns_{0};
  std::atomic<std::uint64_t> tick_count_{0}, ticks_in_servo_steps_{0};
  std::atomic<std::uint64_t> arm_requests_{0};
  std::atomic<std::uint64_t> arrivals_{0};  // times the device began to answer: the finger is elsewhere then
  std::atomic<bool> servo_ready_{false};
  RealtimeGrant grant_;
  LoopCounters servo_counters_, proxy_counters_, reference_counters_;
  std::unique_ptr<StepSink> sink_;
  ServoWatch watch_;

  mutable std::mutex settings_mutex_;  // between the callers of commands; the real-time loops never see it
  ProxyCommands proxy_commands_;
  bool fitted_ = false;  // the workspace has been set, or fitted to a scene
  Latest<ProxyCommands> commands_for_proxy_{ProxyCommands{}};
  std::atomic<LedgerMode> ledger_{LedgerMode::kTank};

  std::mutex commands_mutex_;  // between page and supervisor; the loops never see it
  Commands commands_;
  std::thread servo_thread_, proxy_thread_, supervisor_thread_, reference_thread_;
};

}  // namespace hl
