#include "bodies/cut_piece.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/plain_math.h"
#include "bodies/places.h"

namespace hl {

namespace {

// Evenly over the ball, by the golden angle.
CutPiece::Extremes directionsOverTheBall() {
  CutPiece::Extremes all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto place = static_cast<double>(i);
    const double z = (2 * place + 1) / static_cast<double>(all.size()) - 1, angle = 2.399963229728653 * place;
    const double across = std::sqrt(1 - z * z);
    all[i] = {across * plain::cos(angle), across * plain::sin(angle), z};
  }
  return all;
}

const CutPiece::Extremes& directions() {
  static const CutPiece::Extremes kDirections = directionsOverTheBall();
  return kDirections;
}

// `corners`: ascending, not empty.
CutPiece::Extremes extremesOf(const std::vector<Vec3>& corners) {
  CutPiece::Extremes extremes;
  for (std::size_t i = 0; i < extremes.size(); ++i) {
    const Vec3& way = directions()[i];
    extremes[i] = *std::max_element(corners.begin(), corners.end(),
                                    [&](const Vec3& a, const Vec3& b) { return way.dot(a) < way.dot(b); });
  }
  return extremes;
}

Slab slabOf(const std::vector<Vec3>& corners) {
  double size = 0;
  for (const Vec3& corner : corners) size = std::max(size, (corner - corners[0]).norm());
  return thinnestSlab(corners, size);
}

Box boundsOf(const std::vector<Vec3>& corners) {
  Box bounds;
  for (const Vec3& corner : corners) bounds.extend(corner);
  return bounds;
}

}  // namespace

CutPiece::CutPiece(CutSurface surface) : surface_(std::move(surface)) {
  if (surface_.empty()) return;
  for (const Triangle3& triangle : surface_) {
    corners_.insert(corners_.end(), triangle.begin(), triangle.end());
    if (isTriangle(triangle[0], triangle[1], triangle[2]))
      primitives_.push_back(triangleOf(triangle[0], triangle[1], triangle[2], 0));
  }
  corners_ = sortedPlaces(std::move(corners_));
  extremes_ = extremesOf(corners_);
  bounds_ = boundsOf(corners_);
  slab_ = slabOf(corners_);
}

CutPiece::CutPiece(const CutPiece& a, const CutPiece& b)
    : surface_(a.surface_),
      primitives_(a.primitives_),
      extremes_(joined(a.extremes_, b.extremes_)),
      bounds_(a.bounds_) {
  surface_.insert(surface_.end(), b.surface_.begin(), b.surface_.end());
  primitives_.insert(primitives_.end(), b.primitives_.begin(), b.primitives_.end());
  std::set_union(a.corners_.begin(), a.corners_.end(), b.corners_.begin(), b.corners_.end(),
                 std::back_inserter(corners_), precedesPlace);
  bounds_.extend(b.bounds_);
  slab_ = slabOf(corners_);
}

std::vector<Vec3> CutPiece::thickCorners(double thickness_m) const {
  std::vector<Vec3> corners = corners_;
  const double lacking = thickness_m - slab_.thickness;
  if (lacking <= 0) return corners;
  double out = 0, area = 0;
  for (const Triangle3& triangle : surface_) {
    const Vec3 across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    out += slab_.normal.dot(across);
    area += across.norm();
  }
  const bool is_one_sided = std::abs(out) > 0.5 * area;
  const Vec3 inward = out > 0 ? -slab_.normal : slab_.normal;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back(corners[i] + (is_one_sided ? lacking : lacking / 2) * inward);
    if (!is_one_sided) corners[i] -= lacking / 2 * inward;
  }
  return corners;
}

std::vector<Vec3> distinct(const CutPiece::Extremes& extremes) {
  std::vector<Vec3> places;
  for (const Vec3& place : extremes) {
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  return places;
}

CutPiece::Extremes joined(const CutPiece::Extremes& a, const CutPiece::Extremes& b) {
  CutPiece::Extremes both;
  for (std::size_t i = 0; i < both.size(); ++i) {
    const Vec3& way = directions()[i];
    const double here = way.dot(a[i]), there = way.dot(b[i]);
    both[i] = here > there || (here == there && precedesPlace(a[i], b[i])) ? a[i] : b[i];
  }
  return both;
}

}  // namespace hl
