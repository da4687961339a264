#include "surfaces/cloud_order.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <tuple>

namespace hl {

namespace {

using Points = std::span<LatticePoint>;

LatticeBox boundsOf(std::span<const LatticePoint> points) {
  LatticeBox box{points.front().at, points.front().at};
  for (const LatticePoint& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], point.at[axis]);
      box.high[axis] = std::max(box.high[axis], point.at[axis]);
    }
  }
  return box;
}

std::int64_t sideOf(const LatticeBox& box, std::size_t axis) { return std::int64_t{box.high[axis]} - box.low[axis]; }

std::size_t longestSide(const LatticeBox& box, const Vec3& step) {
  const Vec3 side = step.cwiseProduct(Vec3(static_cast<double>(sideOf(box, 0)), static_cast<double>(sideOf(box, 1)),
                                           static_cast<double>(sideOf(box, 2))));
  Eigen::Index longest = 0;
  side.maxCoeff(&longest);
  return static_cast<std::size_t>(longest);
}

void arrange(Points points, const Vec3& step) {
  constexpr std::size_t kWorthAThread = 50'000;
  const std::size_t blocks = (points.size() + CloudPoints::kPerBlock - 1) / CloudPoints::kPerBlock;
  if (blocks < 2) return;
  const std::size_t axis = longestSide(boundsOf(points), step), next = (axis + 1) % 3, last = (axis + 2) % 3;
  const std::size_t middle = std::bit_floor(blocks - 1) * CloudPoints::kPerBlock;
  const auto place = [&](const LatticePoint& p) { return std::tuple(p.at[axis], p.at[next], p.at[last]); };
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle), points.end(),
                   [&](const LatticePoint& a, const LatticePoint& b) { return place(a) < place(b); });
  const auto first = [&] { arrange(points.first(middle), step); };
  const auto second = [&] { arrange(points.subspan(middle), step); };
  if (points.size() > kWorthAThread) return oneapi::tbb::parallel_invoke(first, second);
  first();
  second();
}

}  // namespace

void sortPoints(std::vector<LatticePoint>& points) {
  oneapi::tbb::parallel_sort(points.begin(), points.end(), [](const LatticePoint& a, const LatticePoint& b) {
    return std::tie(a.at, a.normal) < std::tie(b.at, b.normal);
  });
  // Of points at the same place the last has a normal, if one has.
  std::size_t kept = 0;
  for (const LatticePoint& point : points) {
    if (kept > 0 && points[kept - 1].at == point.at) --kept;
    points[kept++] = point;
  }
  points.resize(kept);
}

void arrangePoints(std::vector<LatticePoint>& points, const Vec3& step) { arrange(points, step); }

int coarserBy(const std::vector<LatticePoint>& arranged) {
  constexpr std::size_t kMaxWideBlocks = 20;  // one in so many
  std::array<std::size_t, 33> needed{};       // blocks by the powers of two that they need
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < arranged.size(); i += CloudPoints::kPerBlock, ++blocks) {
    const LatticeBox box =
        boundsOf(std::span(arranged).subspan(i, std::min(CloudPoints::kPerBlock, arranged.size() - i)));
    const std::int64_t side = std::max({sideOf(box, 0), sideOf(box, 1), sideOf(box, 2)});
    ++needed[static_cast<std::size_t>(
        std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(side))) - 16))];
  }
  std::size_t wide = blocks;
  for (std::size_t powers = 0;; ++powers) {
    wide -= needed[powers];
    if (wide * kMaxWideBlocks <= blocks) return static_cast<int>(powers);
  }
}

void coarsen(std::vector<LatticePoint>& points, CloudLattice& lattice, int powers) {
  if (powers == 0) return;
  const std::int64_t half = std::int64_t{1} << (powers - 1);
  for (LatticePoint& point : points) {
    for (std::int32_t& at : point.at) at = static_cast<std::int32_t>((at + half) >> powers);
  }
  lattice.step *= static_cast<double>(std::int64_t{1} << powers);
}

}  // namespace hl
