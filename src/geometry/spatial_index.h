// SpatialIndex: the interface by which the proxy finds primitives. The structures behind it (boxes, spheres, none) only
// propose candidates. The exact tests are in geometry/queries.h, so all structures give the same result.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/function_ref.h"
#include "base/vec.h"
#include "geometry/element_id.h"

namespace hl {

/// Size of a structure.
struct IndexStats {
  std::size_t nodes = 0;   ///< inner nodes
  std::size_t leaves = 0;  ///< leaf volumes; a primitive may have several of them, or several primitives share one
  std::size_t bytes = 0;   ///< heap memory, without the primitives
  int depth = 0;           ///< inner nodes on the longest path from the root to a leaf
};

/// Queries are const, RT-safe and may run on many threads at once; their stack size is bounded. The cost of a query is
/// the number of bounding volumes visited, the same on every machine.
class SpatialIndex {
 public:
  virtual ~SpatialIndex() = default;
  /// Visits every primitive that may be within `radius` of `centre` (m), in no given order, possibly more than once.
  /// Returns the cost.
  virtual std::size_t overlap(const Vec3& centre, double radius,
                              FunctionRef<void(ElementId primitive)> visit) const = 0;
  /// The same until `stop` returns true; nothing is visited after that. Returns the cost until then, or about.
  virtual std::size_t overlapUntil(const Vec3& centre, double radius,
                                   FunctionRef<bool(ElementId primitive)> stop) const {
    bool stopped = false;
    return overlap(centre, radius, [&](ElementId primitive) { stopped = stopped || stop(primitive); });
  }
  /// Visits every primitive that a sphere of `radius` moving from `from` by `motion` may touch before the limit,
  /// possibly more than once; near ones first if the structure can order them. `visit` receives the current limit (a
  /// fraction of the motion, initially 1) and returns the new one, which must not be larger; the search then continues
  /// only up to it. `soon` (m, >= 0): distance within which an impact is likely; it affects only the computing time.
  /// Returns the cost.
  virtual std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                            FunctionRef<double(ElementId primitive, double limit)> visit) const = 0;
  /// Visits at least every primitive whose distance from `centre` is not above the limit, possibly more than once; near
  /// ones first if the structure can order them. `visit` receives the current limit (m, initially `farthest`, which may
  /// be infinite) and returns the new one, which must not be larger. Returns the cost.
  virtual std::size_t nearest(const Vec3& centre, double farthest,
                              FunctionRef<double(ElementId primitive, double limit)> visit) const {
    double limit = farthest;
    return overlap(centre, farthest, [&](ElementId primitive) { limit = visit(primitive, limit); });
  }
  /// m: the size of a cell, of a structure that makes its primitives anew in each search; 0: they are stored. It
  /// affects only the computing time.
  virtual double cellSize_m() const { return 0; }
  virtual IndexStats stats() const = 0;
};

}  // namespace hl
