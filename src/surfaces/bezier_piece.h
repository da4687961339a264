// BezierPiece: one Bezier patch, whose weights need not be the same: its points, its normal, and how far it is from a
// flat triangle.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/box.h"
#include "surfaces/nurbs_patch.h"

namespace hl {

/// Bounds of the lengths of its second derivatives.
struct PatchCurvature {
  double uu = 0, uv = 0, vv = 0;

  /// Bound of the distance between the surface and a triangle over the half of a cell of 1 / u times 1 / v of its
  /// parameters, by D. Filip, R. Magedson and R. Markot (1986).
  double error(double u, double v) const { return (uu / (u * u) + 2 * uv / (u * v) + vv / (v * v)) / 8; }
};

class BezierPiece {
 public:
  /// Piece number (i, j) of the net.
  BezierPiece(const BezierNet& net, std::size_t i, std::size_t j);

  Vec3 point(double u, double v) const;
  /// Unit, toward where u goes to the right and v up; zero where there is none nearby.
  Vec3 normal(double u, double v) const;
  PatchCurvature curvature() const;
  /// Control points of a side, from u or v = 0 on: v = 0, u = 1, v = 1, u = 0.
  std::vector<ControlPoint> side(std::size_t number) const;

 private:
  std::size_t degree_u_, degree_v_;
  std::vector<ControlPoint> points_;
};

/// A point of a curve with these control points, `part` = 0..1 of the way. A curve whose points are all one is there
/// itself; its ends are the control points to the bit.
Vec3 curvePoint(const std::vector<ControlPoint>& points, double part);

}  // namespace hl
