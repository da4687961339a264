// Joint: what holds two bodies together, or one to the world, and leaves a coordinate free: the angle of a hinge, the
// way of a slider, the distance of two points. A spring, a damper, dry friction, a force table and limits act along the
// coordinate. Kinds and meanings are those of X3D's RigidBodyPhysics (ISO 19775-1, clause 37); fixed and distance are
// HL's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/vec.h"
#include "scene/joint_spec.h"
#include "scene/pose.h"

namespace hl {

/// Frames: that of body a for what ends in _a, that of body b for _b; the world's where body_b is 0.
struct Joint : JointForces {
  std::uint64_t key = 0;  ///< unique among joints; > 0
  JointKind kind = JointKind::kBall;
  std::uint64_t body_a = 0, body_b = 0;                   ///< keys of bodies; body_b 0: the world, which does not move
  Vec3 anchor_a = Vec3::Zero(), anchor_b = Vec3::Zero();  ///< m
  Vec3 axis_a = Vec3::UnitX(), axis_b = Vec3::UnitX();    ///< unit
  Vec3 side_a = Vec3::UnitY(), side_b = Vec3::UnitY();    ///< unit, across the axis: one direction at coordinate 0
  bool collide = false;                                   ///< whether the two bodies also collide with each other
  bool operator==(const Joint&) const = default;
};

/// J, of the spring and the table; those of a rod never act. RT-safe.
double springEnergy_J(const Joint& joint, double coordinate);

/// Whether a distance joint holds its points apart as a rod does.
inline bool isRod(const Joint& joint) { return joint.kind == JointKind::kDistance && joint.low == joint.high; }
/// How many of the six relative velocities a joint holds.
inline std::size_t heldRows(const Joint& joint) {
  if (joint.kind == JointKind::kBall) return 3;
  if (joint.kind == JointKind::kFixed) return 6;
  return joint.kind == JointKind::kDistance ? (isRod(joint) ? 1 : 0) : 5;
}

/// Plain values that change with each step.
struct JointState {
  double coordinate = 0;  ///< m or rad; a hinge counts its whole turns
  double velocity = 0;    ///< m/s or rad/s
  /// Impulses from which the next step begins. N s: of what is held; along the coordinate N s or N m s.
  std::array<double, 6> held{};
  std::array<double, 3> along{};
  /// J that what holds the joint has taken so far and may give back (joint_rows.h).
  double spare_J = 0;
};

/// N or N m, the mean of a step of this length, on body a along the coordinate: of all that acts there. RT-safe.
inline double forceAlong(const JointState& state, double period_s) {
  return (state.along[0] + state.along[1] + state.along[2]) / period_s;
}

/// A joint of two bodies where they are now, with coordinate 0 there. Poses: object to world; pose_b is the identity
/// for the world.
Joint jointAt(JointKind kind, const Vec3& anchor_W, const Vec3& axis_W, const Pose& pose_a, const Pose& pose_b = {});
/// Keeps the distance of the two points as it is now.
Joint distanceBetween(const Vec3& anchor_a_W, const Vec3& anchor_b_W, const Pose& pose_a, const Pose& pose_b = {});

}  // namespace hl
