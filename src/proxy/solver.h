// The exact solver of the paper's equation (1): the point nearest the goal above all planes. The paper's search on the
// hull of the normals is wrong for three or more planes, as the hull truncates the polar cone. This is a dual
// active-set method for three dimensions: at most three planes are active, and the most violated plane joins.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/vec.h"

namespace hl {

/// Planes that are active at once at most, and so the contacts that hold a proxy: one a dimension.
inline constexpr std::size_t kMaxActive = 3;

/// The half-space normal . x >= offset, offset in m; `normal` is unit.
struct Plane {
  Vec3 normal = Vec3::Zero();
  double offset = 0;
};

struct SolverResult {
  Vec3 point = Vec3::Zero();                     ///< the minimiser
  std::size_t active_count = 0;                  ///< 0..kMaxActive
  std::array<std::size_t, kMaxActive> active{};  ///< indices of the active planes
  std::array<double, kMaxActive> multiplier{};   ///< m, >= 0: point - goal = sum multiplier_i normal_i
  double violation = 0;                          ///< m, largest violation of a plane; above the tolerance: infeasible
  std::size_t rounds = 0;                        ///< passes over the planes
};

/// min |x - goal| subject to every plane, each met to within `tolerance` (m, > 0). The order of the planes changes the
/// result only by rounding; sort them for identical bits. RT-safe; each round is linear in the number of planes.
SolverResult nearestAbove(std::span<const Plane> planes, const Vec3& goal, double tolerance);

}  // namespace hl
