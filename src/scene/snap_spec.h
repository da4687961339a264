// Snap spec: a place of an object that holds the proxy until it is pulled off (proxy/snapping.h), as a file or client
// says it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/model.h"

namespace hl {

/// No scene has more that count, and none has more corners together: what a tick costs is bounded.
inline constexpr std::size_t kMaxSnaps = 64, kMaxSnapPoints = 4096;
/// Of one snap.
inline constexpr std::size_t kMaxCorners = 256;

/// Frame of the object.
struct SnapSpec {
  std::string name;
  std::vector<Vec3> points;    ///< m, at least one: a point, or the corners of a polyline
  std::optional<Vec3> normal;  ///< unit: of the plane through the only point; absent: it is no plane
  double capture_m = 0;        ///< > 0, m of the world: it takes a proxy that comes so near
  double release_N = 0;        ///< > 0, at the hand: it lets go of one that is pulled more
  bool operator==(const SnapSpec&) const = default;
};
using SnapList = std::vector<SnapSpec>;

/// A point of a snap or field, and where it may be moved from there without leaving it. Frame of the object.
struct SnapPoint {
  enum class Free : std::uint8_t {
    kNowhere,    ///< of a point, or at an end or corner of a curve
    kAlongAxis,  ///< of a line or curve
    kAcrossAxis  ///< of a plane
  };
  Vec3 point;  ///< m
  Free free = Free::kNowhere;
  Vec3 axis = Vec3::Zero();  ///< unit, unless it is free nowhere
};

/// The point nearest to `p`, m, of the place of a snap or field: its points and its normal. RT-safe.
SnapPoint nearestOn(const std::vector<Vec3>& points, const std::optional<Vec3>& normal, const Vec3& p);

/// The snaps in another frame, of which `placement` makes it. Distances of capture stay as they are. Allocates.
SnapList placed(const SnapList& snaps, const Placement& placement);
std::size_t pointsIn(const SnapList& snaps);
/// Memory that they take.
std::size_t bytesOf(const SnapList& snaps);

}  // namespace hl
