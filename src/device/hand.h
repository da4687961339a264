// A hand that holds the device: fingerpad - hand mass - arm, led by a voluntary trajectory.
// Two-mass grip model (science: Hasser and Cutkosky; Fu and Cavusoglu 2012); the numbers are plausible mid-values:
//   tip --(pad spring, pad damper)-- hand mass --(arm spring, arm damper)-- where the person wants to be.
#pragma once

#include "base/vec.h"

namespace hl {

struct GripParameters {
  double pad_stiffness_N_m, pad_damping_Ns_m;
  double hand_mass_kg;
  double arm_damping_Ns_m, arm_stiffness_N_m;
};

inline constexpr GripParameters kLightGrip{300, 0.8, 0.10, 2, 200};
inline constexpr GripParameters kFirmGrip{800, 2.0, 0.15, 5, 400};

/// The moving parts of the hand. Device frame.
struct HandState {
  Vec3 position = Vec3::Zero();  ///< of the hand mass
  Vec3 velocity = Vec3::Zero();
  Vec3 wish = Vec3::Zero();  ///< the voluntary trajectory
  Vec3 wish_velocity = Vec3::Zero();
};

/// Moves the voluntary trajectory toward the goal: critically damped, no faster than the limit.
void stepWish(HandState& hand, const Vec3& goal, double dt_s);
/// The force of the fingerpad on the tip.
Vec3 padForce(const GripParameters& grip, const HandState& hand, const Vec3& tip, const Vec3& tip_velocity);
/// Advances the hand mass under the reaction of `pad_force` and the pull of the arm (semi-implicit Euler).
void stepHand(const GripParameters& grip, HandState& hand, const Vec3& pad_force, double dt_s);

}  // namespace hl
