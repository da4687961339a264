#include "surfaces/brick_index.h"

#include <algorithm>

#include "surfaces/ball_triangles.h"
#include "surfaces/brick_walk.h"

namespace hl {

namespace {

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
  static void sift(int, BrickParts&) {}
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
