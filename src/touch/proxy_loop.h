// ProxyLoop: one tick as the real-time loops do it, without a thread: takes the newest scene and settings, ticks, and
// gives the servo its target, and the server what was touched.
#pragma once

#include <cstdint>

#include "control/servo.h"
#include "proxy/field_forces.h"
#include "proxy/proxy.h"
#include "touch/body_hand.h"
#include "touch/body_loop.h"
#include "touch/held_contacts.h"
#include "touch/snapshot_slot.h"
#include "touch/target_blend.h"
#include "touch/touch_events.h"
#include "touch/workspace.h"

namespace hl {

/// What may change while the loop runs.
struct ProxyCommands {
  MaterialOverride surfaces{};
  Workspace workspace;
  double radius_W = 0.002;  ///< m, world, > 0
  /// Counts changes of workspace or radius: the proxy then starts anew where the finger is.
  std::uint64_t restarts = 0;
};

/// What a tick must know of the servo.
struct SpringOfServo {
  double stiffness_N_m = 1000;
  LedgerMode ledger = LedgerMode::kTank;
  double period_s = 1e-3;  ///< from tick to tick
  bool pulls = true;       ///< false: the servo makes no force, so that a tick does nothing to any energy
};

/// Input of a tick.
struct TickRequest {
  std::int64_t time_ns = 0;
  Vec3 finger_D = Vec3::Zero();
  ProxyCommands commands;
  SpringOfServo spring;
  BodyCommands on_bodies{};  ///< what clients did to bodies just before
};

struct ProxyStep {
  std::uint64_t scene = 0;  ///< identity of the snapshot
  HeldContacts held;        ///< the target, and how it goes on until the next tick
  TickReport report;
  FixedVector<ObjectName, kMaxActive> touched;  ///< of report.contacts, one by one
  HoldingSnap snap;
  FieldForces fields;
};

/// What the ticks so far have left for the next one, in the scene of the last one.
struct ProxyMemory {
  ProxyState state;
  FadingPull fading;
  ServoTarget last_target;     ///< of the last tick
  std::uint64_t restarts = 0;  ///< as in ProxyCommands
};

/// step() and skip() by one thread at a time, RT-safe; popEvent() by one other.
class ProxyLoop {
 public:
  /// `settings`: passes and iterations; the rest comes with each step.
  ProxyLoop(SnapshotSlot& scenes, const ProxySettings& settings) : scenes_(scenes), settings_(settings) {}

  /// One tick at `now_ns` with the finger at `finger_D`; `most_looks` as in tick().
  ProxyStep step(std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands, const SpringOfServo& spring,
                 int most_looks = kNoWorkCap);
  /// The same in two halves, in this scene: between them `bodies` are stepped, to which the hand is as atBodies() says,
  /// with this number; null: there are none (hands_step.h). RT-safe.
  void begin(const Snapshot& scene, std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands,
             const SpringOfServo& spring);
  HandAtBodies atBodies() const { return hand_.before(state_, settings_, begun_.finger, begun_.pulls); }
  ProxyStep end(BodyWorld* bodies, std::size_t hand, int most_looks = kNoWorkCap);
  /// Takes the newest scene before its time: whether it has bodies that move. RT-safe.
  bool newestHasBodies() {
    scenes_.take();
    return scenes_.hasBodies();
  }
  /// Whether what was given to act() still waits for a step(). RT-safe.
  bool waiting() const { return body_loop_.waiting(); }
  /// Is done to the bodies in the next step(). RT-safe.
  void act(const BodyCommands& commands) { body_loop_.act(commands); }
  const BodyCommands& takeCommands() { return body_loop_.takeCommands(); }
  /// What was done to them in the last step.
  const BodyCommands& done() const { return body_loop_.done(); }
  /// Instead of a tick, when nobody knows where the finger is: takes the newest scene all the same, so that clients who
  /// wait for theirs to be taken do not wait for the device.
  void skip() {
    scenes_.take();
    scenes_.take();  // nothing of the scene before is needed any more
    bodies_ = scenes_.bodies();
    body_loop_.skip();
  }
  const ProxyState& state() const { return state_; }
  /// Of the scene of the last step; null: it has none.
  const BodyWorld* bodies() const { return bodies_; }
  ProxyMemory memory() const { return {state_, blend_.fading(), last_target_, restarts_}; }
  /// Of the bodies of that scene; nothing where it has none. False: there is no room for it. RT-safe.
  bool remember(BodiesMemory& out) const;
  /// Before the first step: goes on as the loop did that had this memory, if its scene is the one that step() takes.
  void resume(const ProxyMemory& memory);
  /// The same for its bodies. Throws hl::Error unless it is of those.
  void resume(const BodiesMemory& memory);
  bool popEvent(TouchEvent& event) { return events_.pop(event); }
  bool popEvent(BodyEvent& event) { return body_loop_.pop(event); }

 private:
  /// What the last tick began with and came to.
  struct LastTick {
    ProxyState from;
    std::int64_t time_ns = 0;
    Vec3 finger_D = Vec3::Zero();
    Vec3 pull_D = Vec3::Zero();  ///< s (proxy - finger), without what fades of scenes before
    int used_up_at = 0;          ///< of its report
  };

  /// A tick that has begun.
  struct Begun {
    const Snapshot* snapshot = nullptr;
    std::int64_t time_ns = 0;
    Vec3 finger_D = Vec3::Zero(), finger = Vec3::Zero();  ///< of now, device and world
    std::uint64_t restarts = 0;
    bool pulls = false;
  };

  void follow(const ProxyCommands& commands, const SpringOfServo& spring);
  void restart();
  bool startsAnew();
  Vec3 changeOfPull(const Snapshot& snapshot);
  Vec3 pullOf(const ProxyState& state, const TickReport& report, const Vec3& finger_D) const;
  double energyOf_J(const ServoTarget& target, const Vec3& finger_D) const;
  void describe(std::int64_t now_ns, const Vec3& finger_D, const SceneAt& scene, ProxyStep& step);
  HoldingSnap snapOf(const Snapshot& snapshot) const;
  HeldContacts heldBy(const TickReport& report, const ServoTarget& target) const;
  ServoTarget targetOf(std::int64_t now_ns, const Vec3& finger_D, const TickReport& report);

  SnapshotSlot& scenes_;
  ProxySettings settings_;
  BodyWorld* bodies_ = nullptr;  // of the scene of the last step; null: it has none
  BodyHand hand_;
  BodyLoop body_loop_;
  Begun begun_;
  Workspace workspace_;
  ProxyState state_;
  ManyRecentPrimitives recent_;
  LastTick last_;
  TargetBlend blend_;
  ServoTarget last_target_;  // in the last tick
  std::uint64_t restarts_ = 0;
  TouchEvents events_;
};

}  // namespace hl
