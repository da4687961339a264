#include "surfaces/brick_index.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surfaces/ball_triangles.h"
#include "surfaces/brick_walk.h"
#include "surfaces/slab_pieces.h"

namespace hl {

namespace {

/// The values of a cell, by a plane through their mean: value + normal . (place - middle), within `rest`.
struct CellPlane {
  explicit CellPlane(const std::array<double, kCellCorners>& values) {
    double most = 0;
    for (unsigned c = 0; c < kCellCorners; ++c) {
      value += values[c] / kCellCorners;
      most = std::max(most, std::abs(values[c]));
      for (unsigned axis = 0; axis < 3; ++axis) normal[axis] += (c >> axis & 1U) != 0 ? values[c] : -values[c];
    }
    normal /= kCellCorners / 2;
    for (unsigned c = 0; c < kCellCorners; ++c) {
      const Vec3 out(0.5 * (c & 1U ? 1 : -1), 0.5 * (c & 2U ? 1 : -1), 0.5 * (c & 4U ? 1 : -1));
      rest = std::max(rest, std::abs(values[c] - value - normal.dot(out)));
    }
    rest += kMoved * most;
  }

  static constexpr double kMoved = 1e-8;  // more than crossing() may move a corner, and than rounding does

  double value = 0, rest = 0;
  Vec3 normal = Vec3::Zero();
};

/// The bricks of a volume's pyramid, in the coordinates of its samples.
class IsoBricks {
 public:
  using Place = IsoCells::Place;

  IsoBricks(const IsoCells& cells, const GridBall& ball)
      : cells_(cells), pyramid_(cells.volume()->pyramid), ball_(ball) {}

  static Vec3 origin() { return Vec3::Zero(); }
  static double step() { return 1; }
  const Vec3& low() const { return ball_.low(); }
  const Vec3& high() const { return ball_.high(); }
  int levels() const { return pyramid_.levels(); }
  std::uint32_t side(int level, std::size_t axis) const { return pyramid_.side(level, axis); }
  std::uint32_t cells(std::size_t axis) const { return cells_.volume()->grid.cells(axis); }
  bool holds(int level, const Place& at) const {
    return pyramid_.range(level, at[0], at[1], at[2]).holds(cells_.iso().value);
  }
  static bool mayCross(const Vec3&) { return true; }
  // Where a cell's values are within `rest` of a plane, so are those of linear interpolation along its edges.
  void sift(int level, BrickParts& parts) const {
    if (level > 0) return;
    const SlabPieces pieces(ball_, cells_.frame(), 1);
    const auto touched = [&](const BrickPart& part) {
      const IsoCell cell = cells_.at(part.at);
      if (cell.triangles == nullptr) return false;
      const CellPlane plane(cell.value);
      const Vec3 middle(part.at[0] + 0.5, part.at[1] + 0.5, part.at[2] + 0.5);
      return pieces.touched(middle, plane.value, plane.normal, plane.rest);
    };
    const auto* end = std::partition(parts.begin(), parts.end(), touched);
    parts.resize(static_cast<std::size_t>(end - parts.begin()));
  }
  static std::size_t cost() { return 0; }
  template <typename Visit>
  void visitCell(const Place& at, const Visit& visit) const {
    const IsoCell cell = cells_.at(at);
    if (cell.triangles == nullptr) return;
    const CellVertices steps(cell), vertices(steps, [this](const Vec3&place) { return cells_.point(place); });
    const BallTriangles near(ball_, cells_.frame());
    for (unsigned n = 0; n < cell.triangles->count; ++n) {
      const auto& edges = cell.triangles->edges[n];
      if (exists(steps[edges]) && near.meets(vertices[edges])) visit(cells_.idOf(cell, n));
    }
  }

 private:
  const IsoCells& cells_;
  const BrickPyramid& pyramid_;
  const GridBall& ball_;
};

}  // namespace

BrickIndex::BrickIndex(const IsoCells& cells, const Box& bounds)
    : WalkedIndex(cells.frame(), bounds, cells.frame().axes.colwise().norm().maxCoeff()), cells_(cells) {}

std::size_t BrickIndex::walk(const GridBall& ball, Visit visit) const {
  IsoBricks bricks(cells_, ball);
  return BrickWalk(bricks, scale(), ball).run(visit);
}

IndexStats BrickIndex::stats() const {
  const BrickPyramid& pyramid = cells_.volume()->pyramid;
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = pyramid.levels();
  stats.leaves = std::size_t{pyramid.side(0, 0)} * pyramid.side(0, 1) * pyramid.side(0, 2);
  stats.nodes = pyramid.bricks() - stats.leaves;
  return stats;
}

}  // namespace hl
