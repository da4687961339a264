#include "surfaces/brick_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "surfaces/ball_triangles.h"
#include "surfaces/brick_walk.h"
#include "surfaces/crossed_cells.h"
#include "surfaces/slab_pieces.h"

namespace hl {

namespace {

/// The values of a cell, by a plane through their mean: value + normal . (place - middle), within `rest`.
///
/// With s = 1 or -1 for the side of a corner along each axis, 8 times the sample there is the sum of
///   V + Sx sx + Sy sy + Sz sz + Mxy sx sy + Myz sy sz + Mzx sz sx + Mxyz sx sy sz.
/// The plane has the first four, and at one of the corners all the others have one sign. Sums of samples that are whole
/// numbers are exact. Where one is missing the plane says nothing, as the cell has no triangles.
struct CellPlane {
  CellPlane(const IsoCells& cells, const IsoCells::Place& at) {
    const VoxelGrid& grid = cells.volume()->grid;
    const std::size_t row = grid.side(0), slice = row * grid.side(1);
    const std::size_t place = at[2] * slice + at[1] * row + at[0];
    grid.samples().as([&](const auto* samples) {
      using Sample = std::remove_cvref_t<decltype(*samples)>;
      using Sum = std::conditional_t<std::is_floating_point_v<Sample>, double, std::int32_t>;
      const auto* const first = samples + place;
      const auto pair = [&](std::size_t corner) { return Pair<Sum>{first[corner], first[corner + 1]}; };
      add(pair(0), pair(row), pair(slice), pair(slice + row));
    });
    const double scale = cells.inward() * grid.values().scale, size = std::abs(scale) / kCellCorners;
    value = cells.inward() * (grid.values().offset - cells.iso().value) + scale / kCellCorners * value;
    normal *= 2 * scale / kCellCorners;
    rest *= size;
    rest += kMoved * (std::abs(value) + normal.cwiseAbs().sum() + rest) +
            kRounding * (std::abs(grid.values().offset) + std::abs(cells.iso().value));
  }

  static constexpr double kMoved = 1e-8;      // more than crossing() may move a corner, and than rounding does
  static constexpr double kRounding = 1e-12;  // of sums that cancel

  double value, rest;
  Vec3 normal;

 private:
  /// Samples that follow each other along x.
  template <typename Sum>
  struct Pair {
    Sum first, last;

    Sum sum() const { return last + first; }
    Sum step() const { return last - first; }
  };

  template <typename Sum>
  void add(const Pair<Sum>& a, const Pair<Sum>& b, const Pair<Sum>& c, const Pair<Sum>& d) {
    const Sum low = a.sum() + b.sum(), high = c.sum() + d.sum(), low_y = b.sum() - a.sum(), high_y = d.sum() - c.sum();
    const Sum low_x = a.step() + b.step(), high_x = c.step() + d.step(), low_xy = b.step() - a.step(),
              high_xy = d.step() - c.step();
    value = low + high;
    normal = Vec3(low_x + high_x, low_y + high_y, high - low);
    rest =
        std::abs(low_xy + high_xy) + std::abs(high_y - low_y) + std::abs(high_x - low_x) + std::abs(high_xy - low_xy);
  }
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
  template <typename Visit>
  static void forEachPart(int, const Place& first, const Place& end, const Visit& visit) {
    forEachPlace(first, end, visit);
  }
  static void sift(int, BrickParts&) {}
  // Where a cell's values are within `rest` of a plane, so are those of linear interpolation along its edges.
  void findCells(const Place& first, const Place& end, BrickParts& parts) {
    cost_ += kCostOfBrick;
    const SlabPieces pieces(ball_, cells_.frame(), 1);
    CrossedCells(cells_.volume()->grid, cells_.bound(), first, end).forEach([&](const Place& at) {
      ++cost_;
      const Vec3 middle(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5);
      if (!pieces.mayTouch(middle)) return;
      const CellPlane plane(cells_, at);
      BrickPart part{ball_.begin(), at};
      if (pieces.touched(middle, plane.value, plane.normal, plane.rest, part.order)) parts.push(part);
    });
  }
  std::size_t cost() const { return cost_; }
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
  static constexpr std::size_t kCostOfBrick = 8;  // looks at boxes

  const IsoCells& cells_;
  const BrickPyramid& pyramid_;
  const GridBall& ball_;
  std::size_t cost_ = 0;
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
