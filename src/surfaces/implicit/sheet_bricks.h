// SheetBricks: the bricks of a sheet for a walk (surfaces/brick_walk.h).
//
// Over a brick the function differs from a plane by at most what its gradient may vary: with c the middle, n the middle
// of the gradient's interval and s half of its length along each axis,
//   |f(x) - f(c) - n . (x - c)| <= e = sum of s half.
// Every corner of the sheet's triangles there lies where linear interpolation of f is 0, so the plane's value is within
// e of 0 on all of each triangle. A brick that has no such place, or none near the ball (plane_reach.h), is left out.
#pragma once

#include "geometry/primitive.h"
#include "surfaces/grid_ball.h"
#include "surfaces/implicit/sheet.h"

namespace hl {

/// For one query; RT-safe.
class SheetBricks {
 public:
  using Place = Sheet::Place;

  /// `frame`: from the function's coordinates, which are those of the ball, to m. They must outlive it. No ball: all
  /// that there is counts.
  SheetBricks(const Sheet& sheet, const GridFrame& frame, const GridBall* ball);

  const Vec3& origin() const { return sheet_.grid().origin; }
  double step() const { return sheet_.grid().step; }
  int levels() const { return sheet_.levels(); }
  std::uint32_t side(int level, std::size_t axis) const { return sheet_.side(level, axis); }
  std::uint32_t cells(std::size_t axis) const { return sheet_.grid().cells[axis]; }
  bool holds(int level, const Place& at);
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  /// visit(id, triangle) with its corners in m.
  template <typename Visit>
  void visitTriangles(const Place& at, const Visit& visit) const {
    if (!mayCross(at)) return;
    const IsoCell cell = sheet_.cellAt(at);
    if (cell.triangles == nullptr) return;
    SheetPieces pieces;
    for (unsigned n = 0; n < cell.triangles->count; ++n) {
      const std::array<Vec3, 3> corners = sheet_.corners(cell, n);
      if (!isNear(placed(corners))) continue;
      sheet_.pieces(corners, pieces);
      for (std::size_t piece = 0; piece < pieces.count; ++piece) {
        const std::array<Vec3, 3> triangle = placed(pieces.triangles[piece]);
        if (!isTriangle(triangle[0], triangle[1], triangle[2]) || !isNear(triangle)) continue;
        visit(SheetTriangle{sheet_.number(), at, n, static_cast<unsigned>(piece)}.id(), triangle);
      }
    }
  }
  template <typename Visit>
  void visitCell(const Place& at, const Visit& visit) const {
    visitTriangles(at, [&](ElementId id, const std::array<Vec3, 3>&) { visit(id); });
  }

 private:
  std::array<Vec3, 3> placed(const std::array<Vec3, 3>& corners) const;
  bool mayCross(const Place& cell) const;
  bool isNear(const std::array<Vec3, 3>& triangle) const;
  bool mayBeSurface(const SmoothFunction::Space& box) const;

  const Sheet& sheet_;
  const GridFrame& frame_;
  const GridBall* ball_;
  // The plane of the last brick: value + normal . (x - middle), within `rest`.
  Vec3 middle_ = Vec3::Zero(), normal_ = Vec3::Zero();
  double value_ = 0, rest_ = 0;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

}  // namespace hl
