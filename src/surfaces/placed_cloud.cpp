#include "surfaces/placed_cloud.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/primitive.h"

namespace hl {

namespace {

// Cosine and sine of the corners of a hexagon.
constexpr double kHigh = 0.8660254037844386;
constexpr std::array<std::array<double, 2>, PlacedCloud::kSides> kHexagon{
    {{1, 0}, {0.5, kHigh}, {-0.5, kHigh}, {-1, 0}, {-0.5, -kHigh}, {0.5, -kHigh}}};

// T. Duff et al., Building an Orthonormal Basis, Revisited (2017).
std::array<Vec3, 2> acrossOf(const Vec3& n) {
  const double sign = n.z() < 0 ? -1 : 1, a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()), Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

}  // namespace

PlacedCloud::PlacedCloud(std::shared_ptr<const CloudPoints> points, const GridFrame& frame, const CloudLook& look)
    : points_(std::move(points)), frame_(frame), look_(look) {
  constexpr double kMinReach = 0.01, kMaxReach = 10;
  if (!(look.reach >= kMinReach && look.reach <= kMaxReach))
    throw Error("a surfel reaches from 0.01 to 10 times the spacing");
  linear_ = frame.axes * points_->lattice().step.cwiseInverse().asDiagonal();
  const Vec3 sizes = linear_.jacobiSvd().singularValues();
  constexpr double kFlattest = 1e-6;
  if (!linear_.allFinite() || !frame.origin.allFinite() || !(sizes[2] > kFlattest * sizes[0]))
    throw Error("the axes of a cloud must be numbers, and must not flatten it");
  stretch_ = sizes[0];
  for_normals_ = linear_.inverse().transpose();
  mirrored_ = linear_.determinant() < 0;
  const LatticeBox box = points_->box(points_->levels() - 1, 0);
  for (unsigned c = 0; c < 8; ++c) {
    const auto at = [&](std::size_t axis) { return (c >> axis & 1U) != 0 ? box.high[axis] : box.low[axis]; };
    bounds_.extend(frame_.point(at(0), at(1), at(2)));
  }
  if (!withinReach(bounds_.min) || !withinReach(bounds_.max)) throw Error("a cloud reaches beyond 1e9 m");
  // A surfel is never so small that rounding flattens it.
  constexpr double kOfCoordinates = 1e-10, kRoundingOfThem = 1e-15;
  const double extent = bounds_.min.cwiseAbs().cwiseMax(bounds_.max.cwiseAbs()).maxCoeff();
  least_radius_ = kOfCoordinates * extent / sizes[2];
  rounding_ = kRoundingOfThem * extent;
  if (!surfels()) return;
  for (std::size_t block = 0; block < points_->blocks(); ++block)
    largest_reach_ = std::max(largest_reach_, reachOf(block));
  bounds_.min.array() -= largest_reach_;
  bounds_.max.array() += largest_reach_;
}

double PlacedCloud::circumradius(std::size_t block) const {
  return std::max(least_radius_, look_.reach / kHigh * points_->spacing(block));
}

Vec3 PlacedCloud::pointAt(std::size_t slot) const {
  const Vec3 at = points_->at(slot);
  return frame_.point(at.x(), at.y(), at.z());
}

Vec3 PlacedCloud::corner(std::size_t slot, std::size_t number, double larger) const {
  const std::array<Vec3, 2> across = acrossOf(unpackNormal(points_->normal(slot)));
  const double radius = larger * circumradius(slot / CloudPoints::kPerBlock);
  const Vec3 way = kHexagon[number][0] * across[0] + kHexagon[number][1] * across[1];
  return pointAt(slot) + radius * (linear_ * way);
}

std::array<Vec3, 3> PlacedCloud::corners(ElementId id) const {
  if (!surfels()) {
    const Vec3 point = pointAt(id);
    return {point, point, point};
  }
  const std::size_t slot = id / kPerSurfel, second = 1 + id % kPerSurfel;
  std::array<std::size_t, 3> number{0, second, second + 1};
  if (mirrored_) std::swap(number[1], number[2]);
  return {corner(slot, number[0], 1), corner(slot, number[1], 1), corner(slot, number[2], 1)};
}

}  // namespace hl
