// SpatialIndex: the one way in which the proxy asks where primitives are. Structures behind it (boxes, spheres,
// nothing) only propose candidates; exact tests are made by geometry/queries.h, so all structures give the same answer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/function_ref.h"
#include "base/vec.h"
#include "geometry/element_id.h"

namespace hl {

/// What a structure costs.
struct IndexStats {
  std::size_t nodes = 0;   ///< inner nodes
  std::size_t leaves = 0;  ///< leaf volumes; a primitive may have several of them, or several primitives share one
  std::size_t bytes = 0;   ///< heap memory, without the primitives
  int depth = 0;           ///< inner nodes on the longest path from the root to a leaf
};

/// Queries are const, RT-safe and may run on many threads at once; the stack they use is bounded. The cost of one is
/// the number of bounding volumes that it has looked at, the same on every machine.
class SpatialIndex {
 public:
  virtual ~SpatialIndex() = default;
  /// Visits every primitive that may come within `radius` of `centre` (metres); may repeat one, in no given order.
  /// Returns its cost.
  virtual std::size_t overlap(const Vec3& centre, double radius,
                              FunctionRef<void(ElementId primitive)> visit) const = 0;
  /// Visits every primitive that a sphere of `radius` moving from `from` by `motion` may touch before the limit, near
  /// ones first where the structure can tell; may repeat one. `visit` is given the present limit (it starts at 1, a
  /// fraction of the motion) and returns the new one, which must not be larger: later candidates are then searched
  /// only up to it. `soon` (m, >= 0): an impact is likely within so much of the way; it decides nothing but how long an
  /// answer takes. Returns its cost.
  virtual std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                            FunctionRef<double(ElementId primitive, double limit)> visit) const = 0;
  virtual IndexStats stats() const = 0;
};

}  // namespace hl
