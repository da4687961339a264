#include "geometry/primitive_source.h"

namespace hl {

Primitive primitiveOf(const PrimitiveSource& source, ElementId id) {
  const std::array<Vec3, 3> corner = source.corners(id);
  return triangleOf(corner[0], corner[1], corner[2], id);
}

}  // namespace hl
