// SheetBricks: the bricks of a sheet for a walk (surfaces/brick_walk.h).
//
// Over a brick the function differs from a plane by at most what its gradient may vary: with c the middle, n the middle
// of the gradient's interval and s half of its length along each axis,
//   |f(x) - f(c) - n . (x - c)| <= e = sum of s half.
// Every corner of the sheet's triangles there lies where linear interpolation of f is 0, so the plane's value is within
// e of 0 on all of each triangle. A brick that has no such place, or none near the ball (plane_reach.h), is left out.
// So are parts of it, by a plane through the function's value in their own middle. With the same normal, e is smaller
// in proportion to their size. From bricks of 16 x 16 x 16 cells down, or of larger ones that are known
// (known_bricks.h), there are bounds H of the second derivatives, and with the function's own gradient as normal
//   e = 1/2 sum of H half half,
// which falls with the square of the size and needs no more intervals.
//
// Where the conditions of the sheet hold nowhere in a brick, it is left out too; what they say of all of it is known to
// its parts and to the cuts of its triangles (sheet_sides.h).
#pragma once

#include <optional>

#include "geometry/primitive.h"
#include "surfaces/ball_triangles.h"
#include "surfaces/brick_walk.h"
#include "surfaces/grid_ball.h"
#include "surfaces/implicit/known_bricks.h"
#include "surfaces/implicit/sheet.h"

namespace hl {

/// For one query; RT-safe.
class SheetBricks {
 public:
  using Place = Sheet::Place;

  /// `frame`: from the function's coordinates, which are those of the ball, to m. They must outlive it. No ball: all
  /// that there is counts. `known`: may be null.
  SheetBricks(const Sheet& sheet, const GridFrame& frame, const GridBall* ball, const KnownBricks* known = nullptr);

  const Vec3& origin() const { return sheet_.grid().origin; }
  double step() const { return sheet_.grid().step; }
  int levels() const { return sheet_.levels(); }
  std::uint32_t side(int level, std::size_t axis) const { return sheet_.side(level, axis); }
  std::uint32_t cells(std::size_t axis) const { return sheet_.grid().cells[axis]; }
  bool holds(int level, const Place& at);
  /// As KnownBrick has it; not a number if the sheet is not in the brick.
  double bendOf(int level, const Place& at);
  const Vec3& low() const { return near_.min; }
  const Vec3& high() const { return near_.max; }
  bool mayCross(const Vec3& middle) const { return !(std::abs(value_ + normal_.dot(middle - middle_)) > crossing_); }
  template <typename Visit>
  void forEachPart(int level, const Place& first, const Place& end, const Visit& visit) const {
    const double side = partSide(level);
    forEachPlace(first, end, [&](const Place& at) {
      if (mayCross(origin() + side * Vec3(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5))) visit(at);
    });
  }
  void sift(int level, BrickParts& parts);
  std::size_t cost() const { return cost_ * sheet_.smooth().bodies() + looks_; }
  /// visit(id, triangle) with its corners in m.
  template <typename Visit>
  void visitTriangles(const Place& at, const Visit& visit) {
    cost_ += kCostOfCell;
    const IsoCell cell = sheet_.cellAt(at);
    if (cell.triangles == nullptr) return;
    const auto to_object = [this](const Vec3& p) { return frame_.point(p.x(), p.y(), p.z()); };
    const CellVertices places(CellVertices(cell), [this](const Vec3& place) { return sheet_.grid().at(place); });
    const CellVertices vertices(places, to_object);
    const std::optional<BallTriangles> near = trianglesNear();
    for (unsigned n = 0; n < cell.triangles->count; ++n) {
      const auto& edges = cell.triangles->edges[n];
      if (near && !near->meets(vertices[edges])) continue;
      SheetPieces pieces;
      sheet_.pieces(places[edges], pieces, sides_[0]);
      looks_ += kLooksOfCut * pieces.looks;
      for (std::size_t piece = 0; piece < pieces.count; ++piece) {
        std::array<Vec3, 3> triangle;
        for (std::size_t i = 0; i < 3; ++i) triangle[i] = to_object(pieces.triangles[piece][i]);
        if (!isTriangle(triangle[0], triangle[1], triangle[2])) continue;
        if (near && pieces.count > 1 && !near->meets(triangle)) continue;
        visit(SheetTriangle{sheet_.number(), at, n, static_cast<unsigned>(piece)}.id(), triangle);
      }
    }
  }
  template <typename Visit>
  void visitCell(const Place& at, const Visit& visit) {
    visitTriangles(at, [&](ElementId id, const std::array<Vec3, 3>&) { visit(id); });
  }

 private:
  /// How the function is bounded over a brick: by its gradient, or also by its second derivatives.
  enum class By : std::uint8_t { kSlopes, kBoth };
  bool planeBySlopes(By by, const Box& box, const SmoothFunction::Space& space);
  bool planeByBend(const Box& box);
  bool mayBeIn(const SmoothFunction::Space& space) const;
  double restByBend(double half) const { return 0.5 * bend_ * half * half * (1 + kRounding); }
  double roundingOf() const;
  double partSide(int level) const;  // of a brick's parts
  std::optional<BallTriangles> trianglesNear() const {
    return ball_ != nullptr ? std::optional(BallTriangles(*ball_, frame_)) : std::nullopt;
  }
  bool mayBeSurface(int level, const Box& box);

  // Looks at boxes, for each body of the function.
  static constexpr std::size_t kCostOfBend = 30, kCostOfBrick = 15, kCostOfCell = 12, kCostOfParts = 6;
  // The same for a body of other functions: over a box, and at the corners of a triangle.
  static constexpr std::size_t kLooksOfSide = 10, kLooksOfCut = 6;
  static constexpr double kRounding = 1e-12;  // of sums of bounds
  static constexpr std::size_t kMaxLevels = 8;
  static_assert(SheetGrid::kMaxCells == std::size_t{1} << 2 * kMaxLevels);

  const Sheet& sheet_;
  const GridFrame& frame_;
  const GridBall* ball_;
  const KnownBricks* known_;
  // The plane of the last brick: value + normal . (x - middle), within `rest`.
  Vec3 middle_ = Vec3::Zero(), normal_ = Vec3::Zero();
  double value_ = 0, rest_ = 0, crossing_ = 0, rounding_ = 0;
  double vary_ = 0;      // sums over the axes: half of what the gradient varies in it
  double bend_ = 0;      // and bounds of the second derivatives in it, or in the brick of level 1 that it is a part of
  bool curved_ = false;  // these give more
  std::size_t cost_ = 0, looks_ = 0;
  std::array<SheetSides, kMaxLevels + 1> sides_;  // of the last brick of each level
  Box near_;                                      // where the ball may meet it in the last brick
};

}  // namespace hl
