#include "scene/bump_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hl {

namespace {

// The slopes at the centres of texels, between which Texture::gradient() interpolates. An image that does not repeat
// ends in a slope of 0 at the centres beside it.
class TexelSlopes {
 public:
  explicit TexelSlopes(const Texture& texture)
      : texture_(texture), first_(texture.wrap == Wrap::kClamp ? -1 : 0), row_(texture.width + (first_ < 0 ? 2 : 1)) {}

  std::ptrdiff_t first() const { return first_; }  // number of the first row; the last one is that of height()
  std::ptrdiff_t last() const { return static_cast<std::ptrdiff_t>(texture_.height); }
  // Per unit of u and v. Valid until the next call.
  std::vector<Vec2>& row(std::ptrdiff_t j) {
    const double width = static_cast<double>(texture_.width), height = static_cast<double>(texture_.height);
    const double v = (static_cast<double>(j) + 0.5) / height;
    for (std::size_t i = 0; i < row_.size(); ++i)
      row_[i] = texture_.gradient({(static_cast<double>(i) + static_cast<double>(first_) + 0.5) / width, v});
    return row_;
  }

 private:
  const Texture& texture_;
  const std::ptrdiff_t first_;
  std::vector<Vec2> row_;
};

// The largest singular value of the matrix with these columns, squared, if it is above `most`; else `most`.
double largerGain(const Vec2& x, const Vec2& y, double most) {
  const double all = x.squaredNorm() + y.squaredNorm();
  if (all <= most) return most;
  const double det = x.x() * y.y() - x.y() * y.x();
  return std::max(most, 0.5 * (all + std::sqrt(std::max(0.0, all * all - 4 * det * det))));
}

// The largest change of the slope per metre, in any direction, where u and v change by `per_m` per metre along
// directions at right angles. The slope is bilinear between four centres, and so its derivative is largest at one.
double imageCurvature(const Texture& texture, const Vec2& per_m) {
  const Vec2 step =
      per_m.cwiseProduct(Vec2(static_cast<double>(texture.width), static_cast<double>(texture.height)));  // per texel
  TexelSlopes slopes(texture);
  std::vector<Vec2> below;
  double most = 0;
  for (std::ptrdiff_t j = slopes.first(); j <= slopes.last(); ++j) {
    std::vector<Vec2>& row = slopes.row(j);
    for (Vec2& slope : row) slope = slope.cwiseProduct(per_m);
    for (std::size_t i = 0; i + 1 < row.size() && !below.empty(); ++i) {
      const Vec2 low = step.x() * (below[i + 1] - below[i]), high = step.x() * (row[i + 1] - row[i]);
      const Vec2 left = step.y() * (row[i] - below[i]), right = step.y() * (row[i + 1] - below[i + 1]);
      for (const Vec2& along_u : {low, high}) most = largerGain(along_u, right, largerGain(along_u, left, most));
    }
    below = row;
  }
  return std::sqrt(most);
}

// How the texture coordinates of a triangle change along it.
struct TexcoordSlope {
  Vec2 per_m = Vec2::Zero();  // of u and of v
  double shear = 0;           // |cos| of the angle between the directions in which they change
};

// Of a triangle that does not exist, as at a missing sample, none. |grad u| = |du1 e2 - du2 e1| / (2 area).
TexcoordSlope texcoordSlope(const Shape& shape, ElementId id) {
  const Primitive triangle = shape.primitive(id);
  std::array<Vec2, 3> texcoord;
  for (std::size_t i = 0; i < 3; ++i) texcoord[i] = shape.cornerTexcoord(triangle.source, triangle.order[i]);
  const Vec3 e1 = triangle.vertex[1] - triangle.vertex[0], e2 = triangle.vertex[2] - triangle.vertex[0];
  const Vec2 d1 = texcoord[1] - texcoord[0], d2 = texcoord[2] - texcoord[0];
  const double area = e1.cross(e2).norm();
  if (!(area > 0)) return {};
  const Vec3 u = d1.x() * e2 - d2.x() * e1, v = d1.y() * e2 - d2.y() * e1;
  const double both = u.norm() * v.norm();
  return {Vec2(u.norm(), v.norm()) / area, both > 0 ? std::abs(u.dot(v)) / both : 0};
}

}  // namespace

bool hasSlope(const Texture& texture, const Vec2& along) {
  TexelSlopes slopes(texture);
  const auto has = [&](const Vec2& slope) { return slope.cwiseProduct(along) != Vec2(0, 0); };
  for (std::ptrdiff_t j = slopes.first(); j <= slopes.last(); ++j) {
    const std::vector<Vec2>& row = slopes.row(j);
    if (std::any_of(row.begin(), row.end(), has)) return true;
  }
  return false;
}

// Where u and v change along directions that are not at right angles, with |cos| c, the change is at most 1 + c times
// as large.
double bumpCurvature_per_m(const Snapshot& snapshot, std::size_t material) {
  const Shape& shape = snapshot.shape();
  const Model& model = shape.model;
  const TextureUse& use = model.materials[material].textureOf(Quantity::kHeight);
  if (!use.used() || !shape.hasTexcoords()) return 0;
  TexcoordSlope most;
  for (ElementId id = 0; id < shape.count(); ++id) {
    if (shape.materialOf(id) != material || shape.kind(id) != PrimitiveKind::kTriangle) continue;
    const TexcoordSlope slope = texcoordSlope(shape, id);
    most.per_m = most.per_m.cwiseMax(slope.per_m);
    most.shear = std::max(most.shear, slope.shear);
  }
  return (1 + most.shear) * std::abs(use.high - use.low) * imageCurvature(model.textures[use.texture], most.per_m);
}

}  // namespace hl
