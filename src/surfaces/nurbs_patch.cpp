#include "surfaces/nurbs_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

constexpr double kFarthestPoint_m = 1e9;

std::size_t pointsAlong(std::uint32_t order, const std::vector<double>& knots) {
  return knots.empty() ? order : knots.size() - std::min<std::size_t>(order, knots.size());
}

// Knots that rise, with a surface between them that does not tear.
void checkKnots(const std::vector<double>& knots, std::uint32_t order, const std::string& name) {
  if (knots.empty()) return;
  if (knots.size() < std::size_t{2} * order) throw Error(name + " must be at least twice the order in number");
  const bool sound =
      std::all_of(knots.begin(), knots.end(), [](double knot) { return std::abs(knot) <= kFarthestPoint_m; });
  if (!sound || !std::is_sorted(knots.begin(), knots.end()))
    throw Error(name + " must be numbers up to 1e9 that do not fall");
  const std::size_t first = order - 1, last = knots.size() - order;
  const double span = knots[last] - knots[first];
  if (!(span > 0)) throw Error(name + " have no span between the first and the last " + std::to_string(order));
  for (std::size_t i = first; i < last; ++i) {
    const double step = knots[i + 1] - knots[i];
    if (step > 0 && step < span / kMaxWeightRatio) throw Error(name + " are too close to each other");
    if (i > first && i + order - 1 < last && knots[i] == knots[i + order - 1])
      throw Error(name + " tear the surface: a knot within it may be there order - 1 times");
  }
}

// x, y, z and 1, each times the weight.
using Homogeneous = Eigen::Vector4d;

// Bezier pieces of a curve of which each control point is a list of `lanes` points. New control point i of a piece from
// a to b is the polar form of the curve at b, i times, and a for the rest: by de Boor's algorithm with these arguments.
class CurveSplitter {
 public:
  CurveSplitter(std::uint32_t order, const std::vector<double>& knots) : degree_(order - 1), knots_(knots) {
    for (std::size_t i = degree_; i + order < knots_.size(); ++i) {
      if (knots_[i] < knots_[i + 1]) spans_.push_back(i);
    }
  }

  std::size_t count() const { return spans_.size() * degree_ + 1; }

  std::vector<double> breaks() const {
    const double begin = knots_[spans_.front()], length = knots_[spans_.back() + 1] - begin;
    std::vector<double> breaks{0};
    for (const std::size_t span : spans_) breaks.push_back((knots_[span + 1] - begin) / length);
    return breaks;
  }

  /// New control point `i`.
  Homogeneous point(std::size_t i, const std::vector<Homogeneous>& old) const {
    const std::size_t piece = std::min(i / degree_, spans_.size() - 1), at_end = i - piece * degree_;
    const std::size_t span = spans_[piece];
    std::array<Homogeneous, kMaxPatchOrder> p;
    for (std::size_t r = 0; r <= degree_; ++r) p[r] = old[span - degree_ + r];
    for (std::size_t s = 1; s <= degree_; ++s) {
      const double x = knots_[s <= at_end ? span + 1 : span];
      for (std::size_t r = degree_; r >= s; --r) {
        const double low = knots_[span - degree_ + r], high = knots_[span + r + 1 - s];
        const double part = (x - low) / (high - low);
        p[r] = (1 - part) * p[r - 1] + part * p[r];
      }
    }
    return p[degree_];
  }

 private:
  std::size_t degree_;
  const std::vector<double>& knots_;
  std::vector<std::size_t> spans_;  // number of the knot at which each begins
};

// The grid with its first side split: columns become pieces, then rows by the same with the grid turned.
std::vector<Homogeneous> splitRows(const std::vector<Homogeneous>& grid, std::size_t columns,
                                   const CurveSplitter& splitter) {
  std::vector<Homogeneous> out, row(columns);
  for (std::size_t begin = 0; begin < grid.size(); begin += columns) {
    std::copy_n(grid.begin() + static_cast<std::ptrdiff_t>(begin), columns, row.begin());
    for (std::size_t i = 0; i < splitter.count(); ++i) out.push_back(splitter.point(i, row));
  }
  return out;
}

std::vector<Homogeneous> turnedGrid(const std::vector<Homogeneous>& grid, std::size_t columns) {
  const std::size_t rows = grid.size() / columns;
  std::vector<Homogeneous> out(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) out[i % columns * rows + i / columns] = grid[i];
  return out;
}

std::vector<double> bezierKnots(std::uint32_t order) {
  std::vector<double> knots(std::size_t{2} * order, 0);
  std::fill(knots.begin() + order, knots.end(), 1);
  return knots;
}

}  // namespace

void checkPatch(const NurbsPatch& patch) {
  for (const std::uint32_t order : {patch.order_u, patch.order_v}) {
    if (order < 2 || order > kMaxPatchOrder) throw Error("orders must be 2 to 8: degree + 1");
  }
  checkKnots(patch.knots_u, patch.order_u, "knotsU");
  checkKnots(patch.knots_v, patch.order_v, "knotsV");
  const std::size_t columns = pointsAlong(patch.order_u, patch.knots_u);
  const std::size_t rows = pointsAlong(patch.order_v, patch.knots_v);
  if (columns > kMaxControlPoints || rows > kMaxControlPoints) throw Error("a side has at most 4096 control points");
  if (patch.points.size() != columns * rows)
    throw Error("there must be " + std::to_string(columns) + " x " + std::to_string(rows) + " control points, not " +
                std::to_string(patch.points.size()));
  double least = patch.points.front().weight, most = least;
  for (const ControlPoint& point : patch.points) {
    if (!point.at.allFinite() || point.at.cwiseAbs().maxCoeff() > kFarthestPoint_m)
      throw Error("points must be numbers up to 1e9");
    least = std::min(least, point.weight);
    most = std::max(most, point.weight);
    if (!(point.weight > 0) || !(most <= kMaxWeightRatio * least) || !(most <= kFarthestPoint_m))
      throw Error("weights must be above 0, and the largest at most 1e6 times the smallest");
  }
}

std::uint64_t mostPiecesOf(const NurbsPatch& patch) {
  const auto along = [](std::size_t order, const std::vector<double>& knots) {
    return knots.empty() ? std::uint64_t{1} : std::uint64_t{knots.size() + 1 - 2 * order};
  };
  return along(patch.order_u, patch.knots_u) * along(patch.order_v, patch.knots_v);
}

BezierNet bezierNetOf(const NurbsPatch& patch) {
  BezierNet net{patch.order_u - 1, patch.order_v - 1, {0, 1}, {0, 1}, patch.points};
  if (patch.knots_u.empty() && patch.knots_v.empty()) return net;
  const std::vector<double> knots_u = patch.knots_u.empty() ? bezierKnots(patch.order_u) : patch.knots_u;
  const std::vector<double> knots_v = patch.knots_v.empty() ? bezierKnots(patch.order_v) : patch.knots_v;
  const CurveSplitter along_u(patch.order_u, knots_u), along_v(patch.order_v, knots_v);
  const std::size_t columns = pointsAlong(patch.order_u, patch.knots_u), rows = patch.points.size() / columns;
  std::vector<Homogeneous> grid;
  for (const ControlPoint& point : patch.points) grid.push_back(point.homogeneous());
  grid = turnedGrid(splitRows(grid, columns, along_u), along_u.count());
  grid = turnedGrid(splitRows(grid, rows, along_v), along_v.count());
  net.breaks_u = along_u.breaks();
  net.breaks_v = along_v.breaks();
  net.points.clear();
  for (const Homogeneous& point : grid) net.points.push_back({Vec3(point.head<3>() / point.w()), point.w()});
  return net;
}

}  // namespace hl
