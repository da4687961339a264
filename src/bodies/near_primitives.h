// Near primitives: which primitives of a scene a convex shape may meet, where there are more than a step has time for.
// They are found by a bound of the separation (separating axes without edges), and chosen evenly: in each octant
// around the shape those that are nearest, and of equally near ones those farthest out, which bear it best.
#pragma once

#include <cstddef>
#include <tuple>

#include "base/fixed_vector.h"
#include "bodies/placed_convex.h"
#include "geometry/closest_point.h"
#include "scene/scene_at.h"

namespace hl {

/// m, at most the gap between the shape and what has this nearest point to its centre: along the way between them.
/// RT-safe.
double separationBound(const PlacedConvex& shape, const ClosestPoint& nearest);
/// The same with the normals of both, too: exact where a face of either is nearest. `nearest`: of `primitive`.
double separationBound(const PlacedConvex& shape, const PlacedConvex& primitive, const ClosestPoint& nearest);

/// The result does not depend on the order in which primitives are added. By one thread at a time.
class NearPrimitives {
 public:
  static constexpr std::size_t kOctants = 8, kPerOctant = 6;

  void clear() {
    for (auto& octant : octants_) octant.clear();
  }
  /// Not twice with the same `id`. RT-safe.
  void add(PrimitiveId id, double separation_m, const ClosestPoint& nearest, const SceneAt& scene);
  /// RT-safe.
  bool has(PrimitiveId id, const ClosestPoint& nearest) const;
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (const auto& octant : octants_) {
      for (const Candidate& one : octant) visit(one.id);
    }
  }

 private:
  struct Candidate {
    PrimitiveId id;
    double separation_um;  // whole numbers: what is as near to a micrometre counts as equally near
    double distance;       // m, from the centre
  };
  static std::size_t octantOf(const ClosestPoint& nearest);
  static bool before(const Candidate& a, const Candidate& b, const SceneAt& scene);

  FixedVector<Candidate, kPerOctant> octants_[kOctants];
};

}  // namespace hl
