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

// Largest change of u or v per metre on a triangle. The edges bound the gradient of an affine map from below, its
// heights from above; |grad u| = |du1 e2 - du2 e1| / (2 area).
double texcoordSlope(const Model& model, const std::array<std::uint32_t, 3>& t) {
  const Vec3 e1 = model.positions[t[1]] - model.positions[t[0]], e2 = model.positions[t[2]] - model.positions[t[0]];
  const Vec2 d1 = model.texcoords[t[1]] - model.texcoords[t[0]], d2 = model.texcoords[t[2]] - model.texcoords[t[0]];
  const double area = e1.cross(e2).norm();
  if (!(area > 0)) return 0;
  return std::max((d1.x() * e2 - d2.x() * e1).norm(), (d1.y() * e2 - d2.y() * e1).norm()) / area;
}

}  // namespace

double bumpCurvature_per_m(const Snapshot& snapshot, std::size_t material) {
  const Shape& shape = snapshot.shape();
  const Model& model = shape.model;
  const TextureUse& use = model.materials[material].textureOf(Quantity::kHeight);
  if (!use.used() || model.texcoords.empty()) return 0;
  double slope = 0;
  for (std::uint32_t i = 0; i < shape.primitives.size(); ++i) {
    if (shape.materialOf(i) == material && shape.primitives.kind(i) == PrimitiveKind::kTriangle)
      slope = std::max(slope, texcoordSlope(model, model.triangles[shape.primitives.source(i)]));
  }
  return std::abs(use.high - use.low) * imageCurvature(model.textures[use.texture]) * slope * slope;
}

}  // namespace hl
