#include "geometry/primitive_source.h"

#include "base/error.h"

namespace hl {

Primitive primitiveOf(const PrimitiveSource& source, ElementId id) {
  const std::array<Vec3, 3> corner = source.corners(id);
  if (source.kind() == PrimitiveKind::kPoint) return pointOf(corner[0], id);
  return triangleOf(corner[0], corner[1], corner[2], id);
}

std::shared_ptr<const PrimitiveSource> PrimitiveSource::placed(const Mat3&, const Vec3&) const {
  throw Error("this surface cannot be scaled");
}

DrawnMesh PrimitiveSource::drawn(std::size_t) const {
  DrawnMesh mesh;
  for (ElementId id = 0; id < count(); ++id) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::array<Vec3, 3> corner = corners(id);
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.positions.push_back(corner[i]);
      mesh.normals.push_back(trueNormal(id, corner[i]));
      if (hasTexcoords()) mesh.texcoords.push_back(texcoord(id, i));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace hl
