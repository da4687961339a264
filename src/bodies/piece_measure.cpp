#include "bodies/piece_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/plain_math.h"
#include "bodies/convex_hull.h"
#include "bodies/hull_faces.h"
#include "bodies/places.h"
#include "geometry/closest_point.h"

namespace hl {

namespace {

Vec3 acrossOf(const Triangle3& triangle) { return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]); }

// Calls visit(point) for points all over a triangle, no farther apart than `apart`, if that is not below an eighth of
// it; of a small one for its middle.
template <typename Visit>
void forEachSample(const Triangle3& triangle, double apart, const Visit& visit) {
  constexpr int kMostParts = 8;
  const Vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
  if (std::isfinite(apart) && longest <= apart / 2) return visit(Vec3(triangle[0] + (u + v) / 3));
  const int parts = std::clamp(static_cast<int>(std::ceil(longest / apart)), 2, kMostParts);
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; j <= parts - i; ++j)
      visit(Vec3(triangle[0] + static_cast<double>(i) / parts * u + static_cast<double>(j) / parts * v));
  }
}

// Evenly over the ball, by the golden angle.
std::vector<Vec3> directions() {
  constexpr int kCount = 48;
  std::vector<Vec3> all;
  for (int i = 0; i < kCount; ++i) {
    const double z = (2 * i + 1.0) / kCount - 1, angle = 2.399963229728653 * i, across = std::sqrt(1 - z * z);
    all.emplace_back(across * plain::cos(angle), across * plain::sin(angle), z);
  }
  return all;
}

std::vector<Vec3> farthestOf(const std::vector<Vec3>& corners) {
  static const std::vector<Vec3> kDirections = directions();
  std::vector<std::size_t> numbers;
  for (const Vec3& way : kDirections) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (way.dot(corners[i]) > way.dot(corners[best])) best = i;
    }
    if (std::find(numbers.begin(), numbers.end(), best) == numbers.end()) numbers.push_back(best);
  }
  return pointsOf(corners, numbers);
}

Slab slabOf(const std::vector<Vec3>& corners) {
  double size = 0;
  for (const Vec3& corner : corners) size = std::max(size, (corner - corners[0]).norm());
  return thinnestSlab(corners, size);
}

// At least so thick: what is flatter grows inward, or, if it faces both ways, to both sides.
std::vector<Vec3> thickened(std::vector<Vec3> corners, const Slab& slab, const CutSurface& surface, double thickness) {
  const double lacking = thickness - slab.thickness;
  if (lacking <= 0) return corners;
  double out = 0, area = 0;
  for (const Triangle3& triangle : surface) {
    out += slab.normal.dot(acrossOf(triangle));
    area += acrossOf(triangle).norm();
  }
  const bool is_one_sided = std::abs(out) > 0.5 * area;
  const Vec3 inward = out > 0 ? -slab.normal : slab.normal;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back(corners[i] + (is_one_sided ? lacking : lacking / 2) * inward);
    if (!is_one_sided) corners[i] -= lacking / 2 * inward;
  }
  return corners;
}

}  // namespace

std::vector<Vec3> CutPiece::corners() const {
  std::vector<Vec3> all;
  for (const Triangle3& triangle : surface) all.insert(all.end(), triangle.begin(), triangle.end());
  return sortedPlaces(std::move(all));
}

std::vector<Vec3> CutPiece::thickCorners(double thickness_m) const {
  std::vector<Vec3> all = corners();
  const Slab slab = slabOf(all);
  return thickened(std::move(all), slab, surface, thickness_m);
}

namespace {

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

std::vector<Primitive> primitivesOf(const CutSurface& surface) {
  std::vector<Primitive> primitives;
  for (const Triangle3& triangle : surface) {
    if (isTriangle(triangle[0], triangle[1], triangle[2]))
      primitives.push_back(triangleOf(triangle[0], triangle[1], triangle[2], 0));
  }
  return primitives;
}

// No more than `most`.
double distanceTo(const std::vector<Primitive>& surface, const Vec3& point, double most) {
  double least = most;
  ClosestPoint closest;
  for (const Primitive& triangle : surface) {
    if (closestPointWithin(triangle, point, least, closest)) least = std::min(least, closest.distance);
  }
  return least;
}

struct AirLine {
  Vec3 middle, direction;
  double air_m = 0;  // how far the middle is from the surface
};

// What is asked of a piece more than once.
struct Outline {
  explicit Outline(const CutPiece& piece) : corners(piece.corners()), surface(primitivesOf(piece.surface)) {}
  std::vector<Vec3> corners;
  Slab slab = slabOf(corners);
  std::vector<Primitive> surface;
};

// Between `most` of the corners at most.
std::vector<AirLine> linesOf(const Outline& outline, std::size_t most) {
  const std::vector<Vec3> corners = farthestOf(outline.corners);
  const std::size_t step = 1 + (corners.size() - 1) / most;
  std::vector<AirLine> lines;
  for (std::size_t i = 0; i < corners.size(); i += step) {
    for (std::size_t j = 0; j < i; j += step) {
      const Vec3 middle = (corners[i] + corners[j]) / 2, way = corners[i] - corners[j];
      lines.push_back({middle, way.normalized(), distanceTo(outline.surface, middle, way.norm() / 2)});
    }
  }
  return lines;
}

HullExcess shellExcess(const Outline& outline, std::size_t most) {
  HullExcess excess;
  for (const AirLine& line : linesOf(outline, most)) {
    if (line.air_m > excess.air_m) excess = {line.air_m, line.air_m, line.middle, line.direction};
  }
  return excess;
}

// The lines of a solid whose middle is not within the whole of it.
HullExcess lineExcess(const Outline& outline, const CutSurface& whole, double allowed_m) {
  constexpr std::size_t kMostCorners = 8;
  HullExcess excess;
  for (const AirLine& line : linesOf(outline, kMostCorners)) {
    if (line.air_m > std::max(excess.error_m, allowed_m) && !isWithin(whole, line.middle))
      excess = {line.air_m, line.air_m, line.middle, line.direction};
  }
  return excess;
}

void followWays(const CutPiece& piece, const Outline& outline, const std::vector<HalfSpace>& hull, double allowed_m,
                HullExcess& excess) {
  constexpr double kApart = 4;           // of what is allowed
  constexpr std::size_t kMostWays = 96;  // that are followed
  std::vector<AirWay> ways = airWays(piece.surface, hull, kApart * allowed_m, 1);
  takeLongest(ways, excess);
  if (excess.air_m <= allowed_m) {
    excess.error_m = excess.air_m;
    return;
  }
  std::erase_if(ways, [&](const AirWay& way) { return way.length_m <= allowed_m; });
  const std::size_t step = 1 + ways.size() / kMostWays;
  for (std::size_t i = 0; i < ways.size(); i += step) {
    const double length = lengthInAir(piece.surface, ways[i]);
    for (const double part : {0.5, 1.0}) {
      const double reach = part * length;
      excess.error_m =
          std::max(excess.error_m, distanceTo(outline.surface, ways[i].begin + reach * ways[i].direction, reach));
    }
  }
}

}  // namespace

HullExcess PieceMeasure::exactly(const CutPiece& piece, double enough_m) const {
  constexpr std::size_t kMostCorners = 48;  // between which lines are drawn
  const Outline outline(piece);
  const bool is_flat = outline.slab.thickness < thickness();
  if (is_shell_ || is_flat) return shellExcess(outline, kMostCorners);
  HullExcess excess = lineExcess(outline, whole_, allowed_m_);
  if (excess.error_m <= enough_m) followWays(piece, outline, hullPlanes(outline.corners), allowed_m_, excess);
  return excess;
}

HullExcess PieceMeasure::roughly(const CutPiece& piece) const {
  constexpr std::size_t kMostTriangles = 128, kMostCorners = 16;
  const Outline outline(piece);
  const bool is_flat = outline.slab.thickness < thickness();
  if (is_shell_ || is_flat) return shellExcess(outline, kMostCorners);
  HullExcess excess = lineExcess(outline, whole_, allowed_m_);
  takeLongest(airWays(piece.surface, hullPlanes(farthestOf(outline.corners)), std::numeric_limits<double>::infinity(),
                      1 + piece.surface.size() / kMostTriangles),
              excess);
  return excess;
}

}  // namespace hl
