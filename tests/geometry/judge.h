// The slow judge of closest points and swept spheres, in long double and by other means than the code it judges:
// distances by projection onto the convex set, times of impact by minimising the distance along the path (a convex
// function, as the set is convex) and bisecting down from the minimum.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/primitive.h"

namespace hl::test {

using Real = long double;
using Vec3L = Eigen::Matrix<Real, 3, 1>;

inline Real distanceToSegment(const Vec3L& a, const Vec3L& b, const Vec3L& p) {
  const Vec3L d = b - a;
  const Real s = std::clamp<Real>(d.dot(p - a) / d.squaredNorm(), 0, 1);
  return (p - (a + s * d)).norm();
}

/// Distance of p to the primitive.
inline Real judgedDistance(const Primitive& primitive, const Vec3L& p) {
  const Vec3L a = primitive.vertex[0].cast<Real>();
  const Vec3L b = primitive.vertex[1].cast<Real>();
  const Vec3L c = primitive.vertex[2].cast<Real>();
  if (primitive.kind == PrimitiveKind::kPoint) return (p - a).norm();
  if (primitive.kind == PrimitiveKind::kSegment) return distanceToSegment(a, b, p);
  const Real edges = std::min({distanceToSegment(a, b, p), distanceToSegment(b, c, p), distanceToSegment(a, c, p)});
  // p = a + u (b - a) + v (c - a) + w n in the frame of the triangle, by Gram-Schmidt on the edges.
  const Vec3L e = b - a;
  const Vec3L x = e.normalized();
  const Vec3L f = c - a;
  const Vec3L across = f - f.dot(x) * x;
  const Vec3L y = (across - across.dot(x) * x).normalized();
  const Real v = (p - a).dot(y) / f.dot(y);
  const Real u = ((p - a).dot(x) - v * f.dot(x)) / e.norm();
  if (u < 0 || v < 0 || u + v > 1) return edges;
  return std::min(edges, std::abs((p - a).dot(x.cross(y))));
}

/// What the judge says of a sweep that starts outside the obstacle.
struct JudgedSweep {
  bool hit = false;
  Real t = 2;        ///< first time at distance `radius`, when hit
  Real nearest = 0;  ///< smallest distance on the path
  Real nearest_t = 0;
};

inline JudgedSweep judgedSweep(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius) {
  const auto distance = [&](Real t) { return judgedDistance(primitive, from.cast<Real>() + t * motion.cast<Real>()); };
  // Ternary search for the minimum of a convex function on [0, 1].
  Real low = 0;
  Real high = 1;
  for (int i = 0; i < 130; ++i) {
    const Real t1 = low + (high - low) / 3;
    const Real t2 = high - (high - low) / 3;
    if (distance(t1) <= distance(t2))
      high = t2;
    else
      low = t1;
  }
  JudgedSweep judged;
  judged.nearest_t = (low + high) / 2;
  for (const Real t : {Real{0}, Real{1}}) {
    if (distance(t) < distance(judged.nearest_t)) judged.nearest_t = t;
  }
  judged.nearest = distance(judged.nearest_t);
  judged.hit = judged.nearest <= radius;
  if (!judged.hit) return judged;
  Real outside = 0;
  Real inside = judged.nearest_t;
  for (int i = 0; i < 70; ++i) {
    const Real middle = (outside + inside) / 2;
    (distance(middle) > radius ? outside : inside) = middle;
  }
  judged.t = inside;
  return judged;
}

}  // namespace hl::test
