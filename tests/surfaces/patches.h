// Patches whose surfaces have closed forms. Metres.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "surfaces/nurbs_patch.h"

namespace hl::test {

/// A curve in the half plane of x >= 0, turned around y: a quadratic NURBS circle of nine points.
inline NurbsPatch turned(const std::vector<ControlPoint>& profile, std::uint32_t order,
                         const std::vector<double>& knots) {
  static const double kHalf = std::sqrt(0.5);
  const std::vector<Vec2> around{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  NurbsPatch patch;
  patch.order_u = 3;
  patch.order_v = order;
  patch.knots_u = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  patch.knots_v = knots;
  for (const ControlPoint& p : profile) {
    for (std::size_t i = 0; i < around.size(); ++i)
      patch.points.push_back(
          {{p.at.x() * around[i].x(), p.at.y(), -p.at.x() * around[i].y()}, p.weight * (i % 2 == 0 ? 1 : kHalf)});
  }
  return patch;
}

/// Around the origin; its poles are sides without length.
inline NurbsPatch spherePatch(double radius) {
  const double r = radius, w = std::sqrt(0.5);
  return turned({{{0, -r, 0}, 1}, {{r, -r, 0}, w}, {{r, 0, 0}, 1}, {{r, r, 0}, w}, {{0, r, 0}, 1}}, 3,
                {0, 0, 0, 1, 1, 2, 2, 2});
}

/// Along y from -half to half, around the y axis.
inline NurbsPatch tube(double radius, double half) {
  return turned({{{radius, -half, 0}}, {{radius, half, 0}}}, 2, {});
}

/// One octant of a sphere around the origin, as a Bezier patch.
inline NurbsPatch octant(double r, const Vec3& sign) {
  const double w = std::sqrt(0.5);
  NurbsPatch patch;
  patch.order_u = patch.order_v = 3;
  const std::vector<ControlPoint> rows{{{r, 0, 0}, 1}, {{r, r, 0}, w}, {{0, r, 0}, 1}};
  for (const ControlPoint& p : rows) {
    const double x = p.at.x(), y = p.at.y();
    for (const ControlPoint& q : {ControlPoint{{x, y, 0}, 1}, ControlPoint{{x, y, x}, w}, ControlPoint{{0, y, x}, 1}})
      patch.points.push_back({q.at.cwiseProduct(sign), p.weight * q.weight});
  }
  return patch;
}

}  // namespace hl::test
