// PrimitiveSource: a surface that is no mesh. Its triangles are made when they are asked for, so it may have more of
// them than there is memory for: a height field, a volume, a formula.
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

/// Immutable; metres, frame of the object. What says RT-safe is called by any thread, and returns the same bits for the
/// same arguments.
class PrimitiveSource {
 public:
  virtual ~PrimitiveSource() = default;
  /// Triangles. RT-safe.
  virtual ElementId count() const = 0;
  /// The three corners, which make a triangle (isTriangle), counterclockwise as seen from outside. RT-safe.
  virtual std::array<Vec3, 3> corners(ElementId id) const = 0;
  /// Unit normal, outward, of the surface that the triangle approximates, near `point` of it. RT-safe.
  virtual Vec3 trueNormal(ElementId id, const Vec3& point) const = 0;
  /// Around all corners.
  virtual Box bounds() const = 0;
  /// What finds its triangles; the source outlives it. Setup only.
  virtual std::unique_ptr<const SpatialIndex> makeIndex() const = 0;
  /// Memory of its own.
  virtual std::size_t bytes() const = 0;
};

/// RT-safe.
Primitive primitiveOf(const PrimitiveSource& source, ElementId id);

}  // namespace hl
