// PrimitiveSource: a surface that is not a mesh. Its triangles are computed on request, so there may be more of them
// than fit into memory: a height field, a volume, a formula.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "base/vec.h"
#include "geometry/box.h"
#include "geometry/element_id.h"
#include "geometry/primitive.h"
#include "geometry/spatial_index.h"

namespace hl {

/// Immutable; metres, object frame. Functions marked RT-safe may be called by any thread and return the same bits for
/// the same arguments.
class PrimitiveSource {
 public:
  virtual ~PrimitiveSource() = default;
  /// Number of triangles. RT-safe.
  virtual ElementId count() const = 0;
  /// The three vertices, which form a valid triangle (isTriangle), counterclockwise seen from outside. RT-safe.
  virtual std::array<Vec3, 3> corners(ElementId id) const = 0;
  /// Outward unit normal of the exact surface that the triangle approximates, near `point` on the triangle. RT-safe.
  virtual Vec3 trueNormal(ElementId id, const Vec3& point) const = 0;
  /// Bounds of all vertices.
  virtual Box bounds() const = 0;
  /// Makes the index of its triangles; the source must outlive it. Setup only.
  virtual std::unique_ptr<const SpatialIndex> makeIndex() const = 0;
  /// Memory of the source, bytes.
  virtual std::size_t bytes() const = 0;
};

/// RT-safe.
Primitive primitiveOf(const PrimitiveSource& source, ElementId id);

}  // namespace hl
