// Rows: the unknown velocities of a step (nodes), and the contacts between them (rows).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/vec.h"
#include "bodies/contact_memory.h"
#include "bodies/world.h"

namespace hl {

/// Something with a velocity: a body, or a hand (no inertia: it does not turn).
struct Node {
  Vec3 velocity = Vec3::Zero();  ///< m/s
  Vec3 spin = Vec3::Zero();      ///< rad/s
  double inverse_mass = 0;       ///< 1/kg
  Mat3 inverse_inertia = Mat3::Zero();
  Vec3 centre = Vec3::Zero();  ///< m, world

  Vec3 velocityAt(const Vec3& arm) const { return velocity + spin.cross(arm); }
  /// 1/kg: velocity at `arm` along the direction of an impulse there, over the impulse.
  double mobilityAt(const Vec3& arm, const Vec3& impulse) const {
    const double square = impulse.squaredNorm();
    if (!(square > 0)) return inverse_mass;
    const Vec3 turning = arm.cross(impulse);
    return inverse_mass + turning.dot(inverse_inertia * turning) / square;
  }
  /// The impulse (N s) acts at `arm` from the centre.
  void push(const Vec3& impulse, const Vec3& arm) {
    velocity += inverse_mass * impulse;
    spin += inverse_inertia * arm.cross(impulse);
  }
};

/// A point of contact. Along the normal gap + T v >= 0; across it Coulomb's cone. What a sweep of the solver reads and
/// writes comes first, and fills whole lines of the cache.
struct alignas(64) Row {
  static constexpr int kFixed = -1;
  static constexpr double kNone = -1e300;
  int a = 0, b = kFixed;  ///< numbers of nodes; the normal points from b to a
  /// Of the solver: what changed since its last solve is solved anew. In part: as far as its work allowed.
  enum class Solved : std::uint8_t { kNo, kRoughly, kInPart, kWhole } solved = Solved::kNo;
  bool slipping = false;
  Vec3 normal = Vec3::UnitZ();
  Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();  ///< m, world, from the centres
  Vec3 carried = Vec3::Zero();                      ///< m/s, of b, where that is scenery
  double friction = 0;                              ///< of this step: static while it sticks
  double pressed = 0;                               ///< N s, >= 0, on a along the normal
  Vec3 dragged = Vec3::Zero();                      ///< N s, on a across the normal
  // Made by prepareRow().
  double normal_step = 0, drag_step = 0;  ///< kg, impulse per velocity
  Vec3 response = Vec3::Zero();           ///< 1/kg, velocity for an impulse along the normal
  // Of the solver.
  double demand = 0;                                  ///< m/s, the least velocity along the normal
  Vec3 change = Vec3::Zero(), search = Vec3::Zero();  ///< N s: of the last sweep, and the direction of the search

  ContactPair pair{};
  double gap = 0;  ///< m
  double static_friction = 0, dynamic_friction = 0;
  double restitution = 0;
  double least_velocity = kNone;  ///< m/s along the normal, that the row demands besides; kNone: nothing
  double approach = 0;            ///< m/s along the normal before the step
};

/// Of the impulses of a step: a few sweeps, or a solution.
enum class Accuracy : std::uint8_t { kRough, kExact };

/// N s, on a.
inline Vec3 impulseOf(const Row& row) { return row.pressed * row.normal + row.dragged; }

/// m/s: the least velocity along the normal that the row allows. RT-safe.
inline double demandOf(const Row& row, double period_s) {
  return std::max(row.least_velocity, -std::max(row.gap, 0.0) / period_s);
}
/// Velocity at the row's point, a's relative to b's. RT-safe.
inline Vec3 relativeVelocity(const Row& row, std::span<const Node> nodes) {
  const Vec3 velocity = nodes[static_cast<std::size_t>(row.a)].velocityAt(row.arm_a);
  return velocity - (row.b == Row::kFixed ? row.carried : nodes[static_cast<std::size_t>(row.b)].velocityAt(row.arm_b));
}
/// Applies an impulse on a, and its opposite on b. RT-safe.
inline void applyImpulse(const Row& row, std::span<Node> nodes, const Vec3& impulse) {
  nodes[static_cast<std::size_t>(row.a)].push(impulse, row.arm_a);
  if (row.b != Row::kFixed) nodes[static_cast<std::size_t>(row.b)].push(-impulse, row.arm_b);
}

/// Number of the node of a body; Row::kFixed: there is no such body. RT-safe.
inline int nodeOf(const World& world, std::uint64_t key) {
  const std::size_t body = world.numberOf(key);
  return body == World::kNoBody ? Row::kFixed : static_cast<int>(body);
}

}  // namespace hl
