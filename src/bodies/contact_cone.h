// Contact cone: the projection of a row's impulse onto Coulomb's cone, and its derivative (newton_solve.h).
#pragma once

#include <cstdint>

#include "bodies/row.h"

namespace hl {

/// Where P + s (d - J v) is projected to, with P the impulse of a row, d - J v what its velocity misses.
struct ConePlace {
  enum class State : std::uint8_t { kApart, kSticks, kSlips } state = State::kApart;
  Vec3 impulse = Vec3::Zero();  ///< N s: the projection
  Vec3 slip = Vec3::Zero();     ///< where it slips: unit, along the friction impulse
  double across_kg = 0;         ///< where it slips: impulse per velocity across the slip, as the drag turns with it
};
/// `impulse`: N s. `velocity`: m/s, of the row's point. `demand`: m/s, the least along the normal. RT-safe.
ConePlace placeInCone(const Row& row, const Vec3& impulse, const Vec3& velocity, double demand);

/// N s: what the row asks for where the projection is linear around `place`, and what must not move has the weight
/// `weight_kg`. `missed`: m/s, the velocity that the row demands less the one that it has. RT-safe.
Vec3 impulseAskedFor(const Row& row, const ConePlace& place, const Vec3& impulse, const Vec3& missed, double weight_kg);
/// kg: by how much that changes against the velocity. RT-safe.
Mat3 impulsePerVelocity(const Row& row, const ConePlace& place, double weight_kg);

}  // namespace hl
