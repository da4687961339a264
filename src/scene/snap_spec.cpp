#include "scene/snap_spec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

SnapPoint nearestOnSegment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double part = square > 0 ? std::clamp(along.dot(p - a) / square, 0.0, 1.0) : 0;
  if (part == 0) return {a};
  if (part == 1) return {b};
  return {a + part * along, SnapPoint::Free::kAlongAxis, along / std::sqrt(square)};
}

}  // namespace

SnapPoint nearestOn(const std::vector<Vec3>& points, const std::optional<Vec3>& normal, const Vec3& p) {
  const Vec3& first = points.front();
  if (normal) return {p - normal->dot(p - first) * *normal, SnapPoint::Free::kAcrossAxis, *normal};
  SnapPoint nearest{first};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const SnapPoint point = nearestOnSegment(points[i - 1], points[i], p);
    const double square = (point.point - p).squaredNorm();
    if (!(square < least)) continue;
    least = square;
    nearest = point;
  }
  return nearest;
}

SnapList placed(const SnapList& snaps, const Placement& placement) {
  SnapList moved = snaps;
  for (SnapSpec& snap : moved) {
    for (Vec3& point : snap.points) point = placement.linear * point + placement.offset;
    if (snap.normal) snap.normal = (placement.linear.inverse().transpose() * *snap.normal).stableNormalized();
  }
  return moved;
}

std::size_t pointsIn(const SnapList& snaps) {
  std::size_t points = 0;
  for (const SnapSpec& snap : snaps) points += snap.points.size();
  return points;
}

std::size_t bytesOf(const SnapList& snaps) {
  std::size_t bytes = sizeof(SnapList) + snaps.capacity() * sizeof(SnapSpec);
  for (const SnapSpec& snap : snaps) bytes += snap.points.capacity() * sizeof(Vec3) + snap.name.capacity();
  return bytes;
}

}  // namespace hl
