// Joint spec: what holds two bodies together, or one to the world, as a file or client says it, where the bodies start.
// Kinds and meanings are those of X3D's RigidBodyPhysics (ISO 19775-1, clause 37); fixed and distance are HL's.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "base/vec.h"
#include "scene/force_table.h"
#include "scene/shared_joint.h"

namespace hl {

enum class JointKind : std::uint8_t {
  kBall,      ///< the anchors are one point; no coordinate
  kHinge,     ///< and the axes one line; the coordinate is the angle of a about the axis of b, rad
  kSlider,    ///< a moves along the axis of b and does not turn; the coordinate is the way, m
  kFixed,     ///< a does not move against b; no coordinate
  kDistance,  ///< nothing is held but the limits of the distance of the anchors; the coordinate is the distance, m
};
/// By number: "ball", "hinge", ...
inline constexpr std::array<const char*, 5> kJointKindNames{"ball", "hinge", "slider", "fixed", "distance"};
constexpr bool hasAxis(JointKind kind) { return kind == JointKind::kHinge || kind == JointKind::kSlider; }
constexpr bool hasCoordinate(JointKind kind) { return kind != JointKind::kBall && kind != JointKind::kFixed; }

/// What acts along the coordinate of a joint, m and N, or rad and N m.
struct JointForces {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();  ///< >= low; equal: it stays there
  double rest = 0;                                        ///< where the spring makes no force
  double spring = 0;                                      ///< N/m or N m/rad, >= 0
  double damping = 0;                                     ///< N s/m or N m s/rad, >= 0
  double friction = 0;                                    ///< N or N m, >= 0, dry: below it the coordinate stands still
  ForceTable table;                                       ///< along the coordinate, on a
  bool operator==(const JointForces&) const = default;
};

/// World frame, with both bodies where they start: the coordinate is 0 there, of a distance it is the distance.
struct JointSpec {
  std::string name;
  JointKind kind = JointKind::kBall;
  std::uint64_t body_a = 0, body_b = 0;  ///< keys of instances; body_b 0: the world, which does not move
  Vec3 anchor_W = Vec3::Zero();          ///< m
  Vec3 anchor_b_W = Vec3::Zero();        ///< m, of kDistance: that of b
  Vec3 axis_W = Vec3::UnitX();           ///< not zero; of a kind that hasAxis()
  JointForces along;
  bool collide = false;  ///< whether the two bodies also collide with each other

  /// Unique among the joints of a scene, and the same from scene to scene; 0: its place in their list, from 1 on.
  std::uint64_t key = 0;
  std::uint32_t session = 0, id = 0;     ///< client session, and its number there
  std::shared_ptr<SharedJoint> shown{};  ///< published after each step; null: nobody asks
  bool operator==(const JointSpec&) const = default;
};

/// No scene has more: what a step costs is bounded.
inline constexpr std::size_t kMaxJoints = 1000;

}  // namespace hl
