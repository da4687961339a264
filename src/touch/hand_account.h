// HandAccount: what a hand owes to the bodies, so that action is reaction to rounding.
//
//   owed    impulses that past forces gave the hand, and no body yet; paid in the next step
//   given   what the last step gave the bodies: first the part of `owed` that was paid before the solve, then what the
//           solve added
//   drawn   impulses of fields, always paid as a whole in the next step
//
// After a tick, settle() adds to `owed` the force of the tick times its period, less what the solve has given.
#pragma once

#include "base/function_ref.h"
#include "bodies/hand_node.h"
#include "proxy/field_forces.h"
#include "proxy/object_forces.h"

namespace hl {

using OwedImpulses = FixedVector<BodyImpulse, kContactsOfHand>;
/// What the fields of bodies take from them.
using DrawnImpulses = FixedVector<BodyImpulse, kMaxFieldsAtOnce>;
/// All that can change for a body in one tick.
using ChangedImpulses = FixedVector<BodyImpulse, ObjectForces::capacity() + GivenImpulses::capacity()>;

/// By the loop that steps the bodies. All is RT-safe.
class HandAccount {
 public:
  const OwedImpulses& owed() const { return owed_; }
  const DrawnImpulses& drawn() const { return drawn_; }
  /// N s, what bodies are still to get.
  Vec3 sum_N_s() const;

  /// Before a step, also one without a solve: it has given nothing yet.
  void beginStep();
  /// What was drawn is to be given now, and is drawn no more.
  DrawnImpulses takeDrawn();
  /// After a solve in which the hand was a node that had owed().
  void pay(const GivenImpulses& given);
  /// After a tick: what each object's contact gave the hand. Of more bodies than there is room for, those that are owed
  /// the least are returned: they are to get it at once.
  ChangedImpulses settle(const World& world, const ObjectForces& forces, double period_s);
  /// After a tick: what the fields of bodies gave the hand.
  void draw(const World& world, const FieldForces& fields, double period_s);

  /// What is owed to others is owed no more.
  void keepOwed(FunctionRef<bool(std::uint64_t key)> goes_on);
  /// Nothing is owed or given any more, and what is drawn stays.
  void forgetOwed();
  void resume(const OwedImpulses& owed, const DrawnImpulses& drawn);

 private:
  ChangedImpulses changesBy(const World& world, const ObjectForces& forces, double period_s, Vec3& of_fixed) const;

  OwedImpulses owed_;
  DrawnImpulses drawn_;
  GivenImpulses given_;
  std::size_t paid_ = 0;  // the first of given_: what was owed
};

}  // namespace hl
