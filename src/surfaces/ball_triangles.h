// BallTriangles: whether a moving ball may touch triangles; quicker than the exact test of those that it does not.
//
// What is near in the plane of a triangle is in a disc around the feet of the centre there (as plane_reach.h has it).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

/// Of the part of the ball's way that counts when this is made. Triangles are in the object frame, m.
class BallTriangles {
 public:
  BallTriangles(const GridBall& ball, const GridFrame& frame)
      : first_(frame.point(ball.first().x(), ball.first().y(), ball.first().z())),
        last_(frame.point(ball.last().x(), ball.last().y(), ball.last().z())),
        rounding_(kRounding * (first_.cwiseAbs().maxCoeff() + last_.cwiseAbs().maxCoeff())),
        radius_(ball.radius()) {}

  bool meets(const std::array<Vec3, 3>& triangle) const {
    const auto& [a, b, c] = triangle;
    const double radius = radius_ + rounding_ + kRounding * a.cwiseAbs().maxCoeff();
    const Vec3 middle = (a + b + c) / 3, out = first_ - middle, across = (b - a).cross(c - a);
    const double around =
        std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()});
    const double square = across.squaredNorm();
    const double per_square = square > kFlattest * kFlattest * around * around ? 1 / square : 0;
    const double from = across.dot(out), to = across.dot(last_ - middle);
    const double least = (from > 0) != (to > 0) ? 0 : std::min(std::abs(from), std::abs(to)) * (1 - kNormalRounding);
    const double left = radius * radius - least * least * per_square;
    if (left < 0) return false;
    const Vec3 foot = out - from * per_square * across, way = (last_ - first_) - (to - from) * per_square * across;
    const double length = way.squaredNorm();
    const double part = length > 0 ? std::clamp(-foot.dot(way) / length, 0.0, 1.0) : 0;
    const double reach = (std::sqrt(left) + std::sqrt(around)) * (1 + kNormalRounding) + kNormalRounding * radius;
    return (foot + part * way).squaredNorm() <= reach * reach;
  }

 private:
  static constexpr double kRounding = 1e-12;  // of coordinates: more than what rounding does to a few sums
  /// The normals of triangles that are flatter have fewer digits than kNormalRounding says.
  static constexpr double kFlattest = 1e-6, kNormalRounding = 1e-9;

  const Vec3 first_, last_;
  const double rounding_, radius_;
};

}  // namespace hl
