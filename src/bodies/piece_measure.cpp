#include "bodies/piece_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bodies/hull_planes.h"
#include "geometry/closest_point.h"

namespace hl {

namespace {

Vec3 acrossOf(const Triangle3& triangle) { return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]); }

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kRaysInALook = 4;  // to meet a triangle by a ray is so much faster than to find its nearest point
constexpr std::size_t kMaxEnds = 48;     // of lines through a shell

// Calls visit(point) for points all over a triangle, no farther apart than `apart`, if that is not below an eighth of
// it; of a small one for its middle.
template <typename Visit>
void forEachSample(const Triangle3& triangle, double apart, const Visit& visit) {
  constexpr int kMaxParts = 8;
  const Vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
  if (std::isfinite(apart) && longest <= apart / 2) return visit(Vec3(triangle[0] + (u + v) / 3));
  const int parts = std::clamp(static_cast<int>(std::ceil(longest / apart)), 2, kMaxParts);
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; j <= parts - i; ++j)
      visit(Vec3(triangle[0] + static_cast<double>(i) / parts * u + static_cast<double>(j) / parts * v));
  }
}

struct AirWay {
  Vec3 begin, direction;
  double length_m = 0;  // until it leaves the hull
};

// From points no farther apart than `apart`, of each triangle after `step` others.
std::vector<AirWay> airWays(const CutSurface& surface, const std::vector<HalfSpace>& hull, double apart,
                            std::size_t step) {
  std::vector<AirWay> ways;
  for (std::size_t i = 0; i < surface.size(); i += step) {
    const Vec3 across = acrossOf(surface[i]);
    if (across.isZero(0)) continue;
    const Vec3 normal = across.normalized();
    forEachSample(surface[i], apart, [&](const Vec3& point) {
      ways.push_back({point, normal, wayOut(hull, point, normal)});
    });
  }
  return ways;
}

void takeLongest(const std::vector<AirWay>& ways, HullExcess& excess) {
  for (const AirWay& way : ways) {
    if (!(way.length_m > excess.air_m)) continue;
    excess.air_m = way.length_m;
    excess.place = way.begin;
    excess.normal = way.direction;
  }
}

// How far along a ray it meets a triangle (T. Moeller, B. Trumbore, Fast, minimum storage ray-triangle intersection,
// 1997); infinite: not, or behind its begin. `inward`: whether it goes in there.
double metAt(const Triangle3& triangle, const Vec3& begin, const Vec3& direction, bool& inward) {
  const Vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], from = begin - triangle[0];
  const Vec3 p = direction.cross(v), q = from.cross(u);
  const double determinant = u.dot(p);
  inward = determinant > 0;
  if (determinant == 0) return std::numeric_limits<double>::infinity();
  const double s = from.dot(p) / determinant, t = direction.dot(q) / determinant, at = v.dot(q) / determinant;
  return s >= 0 && t >= 0 && s + t <= 1 && at >= 0 ? at : std::numeric_limits<double>::infinity();
}

// Where a way meets the surface again, or its end.
double lengthInAir(const CutSurface& surface, const AirWay& way) {
  constexpr double kBegun = 1e-6;  // of the way: it begins on the surface
  double length = way.length_m;
  bool inward = false;
  for (const Triangle3& triangle : surface) {
    const double at = metAt(triangle, way.begin, way.direction, inward);
    if (at > kBegun * way.length_m) length = std::min(length, at);
  }
  return length;
}

// By what a ray in some direction, along which no mesh is drawn, goes out of more often than into.
bool isWithin(const CutSurface& closed, const Vec3& place) {
  const Vec3 direction(0.5377, 0.1834, 0.8231);
  int out = 0;
  bool inward = false;
  for (const Triangle3& triangle : closed) {
    if (metAt(triangle, place, direction, inward) < std::numeric_limits<double>::infinity()) out += inward ? -1 : 1;
  }
  return out > 0;
}

// No more than `most`. Stops once it is no longer above `enough`.
double distanceTo(const std::vector<Primitive>& surface, const Vec3& point, double most, double enough,
                  std::uint64_t& looks) {
  double least = most;
  ClosestPoint closest;
  for (std::size_t i = 0; i < surface.size() && least > enough; ++i, ++looks) {
    if (closestPointWithin(surface[i], point, least, closest)) least = std::min(least, closest.distance);
  }
  return least;
}

// A piece, or two that may be joined.
class Together {
 public:
  explicit Together(const CutPiece& piece) : one_(piece), ends_(distinct(piece.extremes())) {}
  Together(const CutPiece& one, const CutPiece& other)
      : one_(one), other_(&other), ends_(distinct(joined(one.extremes(), other.extremes()))) {}

  const std::vector<Vec3>& ends() const { return ends_; }
  double distanceTo(const Vec3& point, double most, double enough, std::uint64_t& looks) const {
    const double least = hl::distanceTo(one_.primitives(), point, most, enough, looks);
    return other_ == nullptr ? least : hl::distanceTo(other_->primitives(), point, least, enough, looks);
  }

 private:
  const CutPiece& one_;
  const CutPiece* other_ = nullptr;
  std::vector<Vec3> ends_;
};

struct Line {
  Vec3 middle, direction;
  double half_m = 0;
};

// Between `most` of the corners that reach farthest.
std::vector<Line> linesOf(const Together& pieces, std::size_t most) {
  const std::vector<Vec3>& corners = pieces.ends();
  const std::size_t step = 1 + (corners.size() - 1) / most;
  std::vector<Line> lines;
  for (std::size_t i = 0; i < corners.size(); i += step) {
    for (std::size_t j = 0; j < i; j += step) {
      const Vec3 way = corners[i] - corners[j];
      lines.push_back({(corners[i] + corners[j]) / 2, way.normalized(), way.norm() / 2});
    }
  }
  return lines;
}

// Until the error is above `enough`.
HullExcess shellExcess(const Together& pieces, std::size_t most, double enough) {
  HullExcess excess;
  for (const Line& line : linesOf(pieces, most)) {
    if (excess.error_m > enough) break;
    const double air = pieces.distanceTo(line.middle, line.half_m, excess.error_m, excess.looks);
    if (air > excess.error_m) excess = {air, air, line.middle, line.direction, excess.looks};
  }
  return excess;
}

// The lines of a solid whose middle is not within the whole of it. Until the error is above `enough`.
HullExcess lineExcess(const Together& pieces, const CutSurface& whole, double allowed_m, double enough) {
  constexpr std::size_t kMaxCorners = 8;
  HullExcess excess;
  for (const Line& line : linesOf(pieces, kMaxCorners)) {
    if (excess.error_m > enough) break;
    const double known = std::max(excess.error_m, allowed_m);
    const double air = pieces.distanceTo(line.middle, line.half_m, known, excess.looks);
    if (!(air > known)) continue;
    excess.looks += whole.size() / kRaysInALook;
    if (!isWithin(whole, line.middle)) excess = {air, air, line.middle, line.direction, excess.looks};
  }
  return excess;
}

void followWays(const CutPiece& piece, const std::vector<HalfSpace>& hull, double allowed_m, HullExcess& excess) {
  constexpr double kApart = 4;          // of what is allowed
  constexpr std::size_t kMaxWays = 96;  // that are followed
  std::vector<AirWay> ways = airWays(piece.surface(), hull, kApart * allowed_m, 1);
  excess.looks += (ways.size() + piece.corners().size()) * hull.size();
  takeLongest(ways, excess);
  if (excess.air_m <= allowed_m) {
    excess.error_m = excess.air_m;
    return;
  }
  std::erase_if(ways, [&](const AirWay& way) { return way.length_m <= allowed_m; });
  const std::size_t step = 1 + ways.size() / kMaxWays;
  for (std::size_t i = 0; i < ways.size(); i += step) {
    const double length = lengthInAir(piece.surface(), ways[i]);
    excess.looks += piece.surface().size();
    for (const double part : {0.5, 1.0}) {
      const double reach = part * length;
      const Vec3 place = ways[i].begin + reach * ways[i].direction;
      const double air = distanceTo(piece.primitives(), place, reach, excess.error_m, excess.looks);
      excess.error_m = std::max(excess.error_m, air);
    }
  }
}

}  // namespace

HullExcess PieceMeasure::exactly(const CutPiece& piece) const {
  HullExcess excess = isShell(piece) ? shellExcess(Together(piece), kMaxEnds, kNever)
                                     : lineExcess(Together(piece), whole_, allowed_m_, kNever);
  if (!isShell(piece)) followWays(piece, hullPlanes(piece.corners()), allowed_m_, excess);
  return excess;
}

HullExcess PieceMeasure::atLeast(const CutPiece& a, const CutPiece& b, double enough_m) const {
  if (is_shell_) return shellExcess(Together(a, b), kMaxEnds, enough_m);
  return isShell(a) && isShell(b) ? HullExcess{} : lineExcess(Together(a, b), whole_, allowed_m_, enough_m);
}

HullExcess PieceMeasure::roughly(const CutPiece& piece) const {
  constexpr std::size_t kMaxTriangles = 128, kFewEnds = 16;
  if (isShell(piece)) return shellExcess(Together(piece), kFewEnds, kNever);
  HullExcess excess = lineExcess(Together(piece), whole_, allowed_m_, kNever);
  const std::vector<HalfSpace> hull = hullPlanes(distinct(piece.extremes()));
  const auto ways = airWays(piece.surface(), hull, kNever, 1 + piece.surface().size() / kMaxTriangles);
  excess.looks += ways.size() * hull.size();
  takeLongest(ways, excess);
  return excess;
}

}  // namespace hl
