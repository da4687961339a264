#include "bodies/convex_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace hl {

namespace {

// Of the size of the surface.
constexpr double kRounding = 1e-12;
// Into which surfaces are cut. Solids have fewer; of sheets that cross each other, each cut of many makes more.
constexpr std::size_t kMaxFragments = 4000, kMaxFragmentsOfOne = 4;
// What it takes to make a piece, for each of its triangles, in looks.
constexpr std::uint64_t kLooksToMake = 100;

Vec3 acrossFace(const Triangle3& triangle) { return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]); }

double areaOf(const CutSurface& surface) {
  double area = 0;
  for (const Triangle3& triangle : surface) area += acrossFace(triangle).norm() / 2;
  return area;
}

// The planes of the largest triangles, each once.
std::vector<HalfSpace> largestFaces(const CutSurface& surface, double rounding_m) {
  constexpr std::size_t kFaces = 3;
  std::vector<HalfSpace> faces;
  const auto is_known = [&](const Triangle3& triangle) {
    return std::any_of(faces.begin(), faces.end(), [&](const HalfSpace& face) {
      return std::all_of(triangle.begin(), triangle.end(),
                         [&](const Vec3& corner) { return std::abs(face.above(corner)) <= rounding_m; });
    });
  };
  while (faces.size() < kFaces) {
    Vec3 largest = Vec3::Zero();
    const Triangle3* found = nullptr;
    for (const Triangle3& triangle : surface) {
      const Vec3 across = acrossFace(triangle);
      if (!(across.squaredNorm() > largest.squaredNorm()) || is_known(triangle)) continue;
      largest = across;
      found = &triangle;
    }
    if (found == nullptr) break;
    const Vec3 normal = largest.normalized();
    faces.push_back({normal, normal.dot((*found)[0])});
  }
  return faces;
}

struct MeasuredPiece {
  CutPiece piece;
  HullExcess excess;
  std::size_t number = 0;  // of no other
  bool cuttable = true;
  // How much it asks to be cut.
  double need_m() const { return cuttable ? excess.error_m : 0; }
};
using Halves = std::array<MeasuredPiece, 2>;

class Cutter {
 public:
  Cutter(const CutPiece& whole, const CutRules& rules)
      : whole_(whole),
        rules_(rules),
        measure_(whole.surface(), rules.is_shell, rules.allowed_m),
        rounding_m_(kRounding * whole.bounds().size().norm()) {}

  std::vector<MeasuredPiece> whole() { return {measured(whole_)}; }

  bool needsCut(const std::vector<MeasuredPiece>& all) const {
    return mayGoOn() && all.size() < rules_.most && std::any_of(all.begin(), all.end(), [&](const MeasuredPiece& one) {
             return one.need_m() > rules_.allowed_m;
           });
  }

  // Until none is too far from its hull, or there are as many as may be.
  void cut(std::vector<MeasuredPiece>& all) {
    while (mayGoOn() && all.size() < rules_.most) {
      const auto worst = std::max_element(all.begin(), all.end(), [](const MeasuredPiece& a, const MeasuredPiece& b) {
        return a.need_m() < b.need_m();
      });
      if (!(worst->need_m() > rules_.allowed_m)) break;
      const std::optional<HalfSpace> plane = bestPlane(*worst);
      worst->cuttable = plane.has_value();
      if (!plane) continue;
      Halves halves{measured(half(worst->piece, *plane)), measured(half(worst->piece, plane->turned()))};
      fragments_ += halves[0].piece.surface().size() + halves[1].piece.surface().size() - worst->piece.surface().size();
      *worst = std::move(halves[0]);
      all.push_back(std::move(halves[1]));
    }
  }

  // Puts together again what two cuts have parted though it is near enough.
  void joinNeighbours(std::vector<MeasuredPiece>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; mayGoOn() && j < all.size();) {
        std::optional<MeasuredPiece> both = joined(all[i], all[j]);
        if (!both) {
          apart_.insert({all[i].number, all[j].number});
          ++j;
          continue;
        }
        all[i] = *std::move(both);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      }
    }
  }

 private:
  bool mayGoOn() const {
    return looks_ < rules_.looks_of_each * whole_.surface().size() &&
           fragments_ <= kMaxFragments + kMaxFragmentsOfOne * whole_.surface().size();
  }

  HullExcess counted(const HullExcess& excess) {
    looks_ += excess.looks;
    return excess;
  }

  MeasuredPiece measured(CutPiece piece) {
    const HullExcess excess = counted(measure_.exactly(piece));
    return {std::move(piece), excess, ++made_};
  }

  std::vector<HalfSpace> planesFor(const MeasuredPiece& piece) const {
    constexpr int kPlaces = 4;
    constexpr double kOblique = 0.1;
    const HullExcess& at = piece.excess;
    const Box bounds = roundedBounds(piece.piece);
    std::vector<HalfSpace> planes;
    const auto through = [&](const Vec3& normal) { planes.push_back({normal, normal.dot(at.place)}); };
    through(at.normal);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vec3 normal = Vec3::Unit(axis), across = at.normal.cross(normal);
      through(normal);
      if (across.norm() > kOblique) through(across.normalized());
      for (int i = 1; i < kPlaces; ++i)
        planes.push_back({normal, bounds.min[axis] + i * bounds.size()[axis] / kPlaces});
    }
    if (rules_.is_shell) addBesideFaces(piece.piece, planes);
    return planes;
  }

  // Planes that cut a wall of a shell from what is around it, with rims that are no higher than it is thick.
  void addBesideFaces(const CutPiece& piece, std::vector<HalfSpace>& planes) const {
    for (const HalfSpace& face : largestFaces(piece.surface(), rounding_m_)) {
      for (const double beside : {-measure_.thickness(), measure_.thickness()})
        planes.push_back({face.normal, face.offset + beside});
    }
  }

  // Of a solid the way through the air, of a shell its mean over the area: or thin strips would be cut off again and
  // again, without air in them, and what is left would have as much as before.
  double scoreOf(const CutPiece& one, const CutPiece& other) {
    const HullExcess here = counted(measure_.roughly(one)), there = counted(measure_.roughly(other));
    if (!rules_.is_shell) return here.air_m + there.air_m;
    const double area = areaOf(one.surface()), other_area = areaOf(other.surface());
    return (area * here.air_m + other_area * there.air_m) / (area + other_area);
  }

  // None, if no plane cuts the piece.
  std::optional<HalfSpace> bestPlane(const MeasuredPiece& whole) {
    constexpr double kOfBalance = 0.01;  // where planes leave the same, the halves are to be alike
    double best = std::numeric_limits<double>::infinity();
    std::optional<HalfSpace> best_plane;
    for (const HalfSpace& plane : planesFor(whole)) {
      const CutPiece one = half(whole.piece, plane), other = half(whole.piece, plane.turned());
      if (one.empty() || other.empty()) continue;
      const double uneven = std::abs(one.bounds().size().norm() - other.bounds().size().norm());
      const double score = scoreOf(one, other) + kOfBalance * uneven;
      if (!(score < best)) continue;
      best = score;
      best_plane = plane;
    }
    return best_plane;
  }

  CutPiece half(const CutPiece& piece, const HalfSpace& plane) {
    looks_ += piece.surface().size() * kLooksToMake;
    return CutPiece(above(piece.surface(), plane, rounding_m_));
  }

  Box roundedBounds(const CutPiece& piece) const {
    Box bounds = piece.bounds();
    bounds.min.array() -= rounding_m_;
    bounds.max.array() += rounding_m_;
    return bounds;
  }

  // None, if it would be too far from its hull.
  std::optional<MeasuredPiece> joined(const MeasuredPiece& a, const MeasuredPiece& b) {
    if (apart_.contains({a.number, b.number}) || !roundedBounds(a.piece).meets(roundedBounds(b.piece)))
      return std::nullopt;
    looks_ += CutPiece::kDirections;
    if (counted(measure_.atLeast(a.piece, b.piece, rules_.allowed_m)).error_m > rules_.allowed_m) return std::nullopt;
    looks_ += (a.piece.surface().size() + b.piece.surface().size()) * kLooksToMake;
    MeasuredPiece both = measured(CutPiece(a.piece, b.piece));
    if (both.excess.error_m > rules_.allowed_m) return std::nullopt;
    return both;
  }

  const CutPiece& whole_;
  const CutRules& rules_;
  PieceMeasure measure_;
  double rounding_m_;
  std::size_t fragments_ = whole_.surface().size();
  std::uint64_t looks_ = 0;
  std::size_t made_ = 0;
  std::set<std::pair<std::size_t, std::size_t>> apart_;  // that are known not to be one
};

}  // namespace

std::vector<NearPiece> cutPieces(const CutPiece& whole, const CutRules& rules) {
  constexpr int kMaxRounds = 6;  // what is joined leaves room for cuts
  Cutter cutter(whole, rules);
  std::vector<MeasuredPiece> measured = cutter.whole();
  for (int i = 0; i < kMaxRounds && cutter.needsCut(measured); ++i) {
    cutter.cut(measured);
    cutter.joinNeighbours(measured);
  }
  std::vector<NearPiece> pieces;
  pieces.reserve(measured.size());
  for (MeasuredPiece& one : measured) pieces.push_back({std::move(one.piece), one.excess.error_m});
  return pieces;
}

}  // namespace hl
