#include "scene/bump_gain.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Largest second difference of the image along u or v, per squared unit of u or v.
double imageCurvature(const Texture& texture) {
  const double du = 1.0 / static_cast<double>(texture.width), dv = 1.0 / static_cast<double>(texture.height);
  double most = 0;
  for (std::size_t j = 0; j < texture.height; ++j) {
    for (std::size_t i = 0; i < texture.width; ++i) {
      const Vec2 at((static_cast<double>(i) + 0.5) * du, (static_cast<double>(j) + 0.5) * dv);
      const double here = texture.sample(at);
      const auto second = [&](const Vec2& step) {
        return texture.sample(at + step) - 2 * here + texture.sample(at - step);
      };
      most = std::max({most, std::abs(second({du, 0})) / (du * du), std::abs(second({0, dv})) / (dv * dv)});
    }
  }
  return most;
}

// Largest change of u or v per metre on a triangle; of one that does not exist, as at a missing sample, 0. The edges
// bound the gradient of an affine map from below, its heights from above; |grad u| = |du1 e2 - du2 e1| / (2 area).
double texcoordSlope(const Shape& shape, ElementId id) {
  const Primitive triangle = shape.primitive(id);
  std::array<Vec2, 3> texcoord;
  for (std::size_t i = 0; i < 3; ++i) texcoord[i] = shape.cornerTexcoord(triangle.source, triangle.order[i]);
  const Vec3 e1 = triangle.vertex[1] - triangle.vertex[0], e2 = triangle.vertex[2] - triangle.vertex[0];
  const Vec2 d1 = texcoord[1] - texcoord[0], d2 = texcoord[2] - texcoord[0];
  const double area = e1.cross(e2).norm();
  if (!(area > 0)) return 0;
  return std::max((d1.x() * e2 - d2.x() * e1).norm(), (d1.y() * e2 - d2.y() * e1).norm()) / area;
}

}  // namespace

double bumpCurvature_per_m(const Snapshot& snapshot, std::size_t material) {
  const Shape& shape = snapshot.shape();
  const Model& model = shape.model;
  const TextureUse& use = model.materials[material].textureOf(Quantity::kHeight);
  if (!use.used() || !shape.hasTexcoords()) return 0;
  double slope = 0;
  for (ElementId id = 0; id < shape.count(); ++id) {
    if (shape.materialOf(id) == material && shape.kind(id) == PrimitiveKind::kTriangle)
      slope = std::max(slope, texcoordSlope(shape, id));
  }
  return std::abs(use.high - use.low) * imageCurvature(model.textures[use.texture]) * slope * slope;
}

}  // namespace hl
