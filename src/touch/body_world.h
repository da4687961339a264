// BodyWorld: the bodies of a scene within the loop that ticks. Each tick is
//
//   step the bodies, the proxies of all hands nodes among them -> each hand: carry -> tick -> settle
//
// so that a body has answered the very sample for which the tick is made. What the tick's force gives the hand beyond
// what the bodies got is owed to them, and paid in the next step (hand_account.h): action is reaction to rounding.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "bodies/body_step.h"
#include "proxy/field_forces.h"
#include "proxy/object_forces.h"
#include "scene/rigid_body.h"
#include "touch/bodies_memory.h"
#include "touch/body_acts.h"
#include "touch/body_command.h"
#include "touch/body_view.h"
#include "touch/hand_account.h"
#include "touch/joint_views.h"
#include "touch/lost_bodies.h"

namespace hl {

/// What the last tick left: the proxy's contacts and spring. World frame.
struct HandAtBodies {
  FixedVector<HandContact, kContactsOfHand> contacts;
  Vec3 proxy = Vec3::Zero();    ///< m
  double radius_m = 0;          ///< of the proxy; 0: it is nowhere
  Vec3 stretch = Vec3::Zero();  ///< m, proxy - the finger of now
  double spring_N_m = 0;        ///< with the stiffness of the surface; 0: the servo makes no force
};

/// By the loop that ticks.
class BodyWorld {
 public:
  static constexpr std::uint64_t kViewEvery = 16;

  /// The bodies of a snapshot, where they start; null: it has none. Throws hl::Error where one cannot be made.
  static std::unique_ptr<BodyWorld> of(const Snapshot& snapshot);

  /// Before the first step: bodies that were in `before`, and start where they started there, go on from where they are
  /// in it. RT-safe.
  void continueFrom(const BodyWorld& before);
  /// What clients do to bodies, before the next step. Energy that it brings is booked as theirs. RT-safe.
  void act(const BodyCommands& commands);
  /// Moves the bodies from the last step's moment to `now_ns`, by `period_s` of their time. `hands`: kMaxHands at
  /// most, each at its number. RT-safe.
  void step(std::int64_t now_ns, double period_s, std::span<const HandAtBodies> hands);
  /// After the tick of a hand: what each object's contact gives it. RT-safe.
  void settle(std::size_t hand, const ObjectForces& forces, double period_s);
  /// After the tick: what the fields of bodies give the hand, and so take from them in the next step. RT-safe.
  void draw(std::size_t hand, const FieldForces& fields, double period_s);

  /// Between two ticks, of one hand, number 0, all but BodiesMemory::held_by. False: there is no room for it. RT-safe.
  bool remember(BodiesMemory& out) const;
  /// Before the first step: goes on as the world did that had this memory. Throws hl::Error if it is of other bodies.
  void resume(const BodiesMemory& memory);

  /// Of body number `i`, m/s and rad/s; between two steps. RT-safe.
  void set(std::size_t i, const Vec3& velocity, const Vec3& spin);

  const World& world() const { return stepper_.world(); }
  const WorldState& state() const { return state_; }
  const BodyStepReport& report() const { return report_; }
  /// As World::bodies.
  const RigidBody& body(std::size_t i) const { return *bodies_[i]; }
  /// N s that bodies are still to get.
  Vec3 owed_N_s() const;
  /// Renewed in one of kViewEvery steps.
  const BodyView& view() const { return view_; }

 private:
  BodyWorld(const std::shared_ptr<const World>& world, std::vector<std::shared_ptr<const RigidBody>> bodies,
            JointViews joint_views);
  void continueJoints(const BodyWorld& before);
  bool goesOn(std::uint64_t key, const BodyWorld& before) const;
  bool standsAs(const BodyWorld& before) const;
  MovingBodies moving() { return {world(), state_, bodies_}; }
  double energy_J() const;
  void showMobility();
  void stepAmong(std::span<const HandAtBodies> hands, double period_s, const StepTimes& times);
  void payDrawn();
  void returnLost(const EnergyBook& before);
  void forgetStep(const EnergyBook& before);
  void putBackLost();
  void count(double late_s);

  std::vector<std::shared_ptr<const RigidBody>> bodies_;
  BodyStepper stepper_;
  WorldState state_;
  JointViews joint_views_;
  std::array<HandAccount, kMaxHands> accounts_;  // by the hand's number
  BodyPushes pushes_;
  BodyStepReport report_;
  std::int64_t time_ns_ = 0;
  bool begun_ = false;
  bool mobility_shown_ = false;
  BodyView view_;
  LostBodies lost_;
};

}  // namespace hl
