#include "bodies/convex_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/box.h"

namespace hl {

namespace {

// Of the size of the surface.
constexpr double kRounding = 1e-12;

struct MeasuredPiece {
  CutPiece piece;
  HullExcess excess;
  bool cuttable = true;
  // How much it asks to be cut.
  double need_m() const { return cuttable ? excess.error_m : 0; }
};
using Halves = std::array<MeasuredPiece, 2>;

class Cutter {
 public:
  Cutter(const CutSurface& surface, const CutRules& rules)
      : surface_(surface), rules_(rules), measure_(surface, rules.is_shell, rules.allowed_m) {
    rounding_m_ = kRounding * boundsOf({surface}).size().norm();
  }

  std::vector<MeasuredPiece> whole() const { return {measured({surface_})}; }

  bool needsCut(const std::vector<MeasuredPiece>& all) const {
    return all.size() < rules_.most && std::any_of(all.begin(), all.end(), [&](const MeasuredPiece& one) {
             return one.need_m() > rules_.allowed_m;
           });
  }

  // Until none is too far from its hull, or there are as many as may be.
  void cut(std::vector<MeasuredPiece>& all) const {
    while (all.size() < rules_.most) {
      const auto worst = std::max_element(all.begin(), all.end(), [](const MeasuredPiece& a, const MeasuredPiece& b) {
        return a.need_m() < b.need_m();
      });
      if (!(worst->need_m() > rules_.allowed_m)) break;
      const std::optional<HalfSpace> plane = bestPlane(*worst);
      worst->cuttable = plane.has_value();
      if (!plane) continue;
      Halves halves{measured(half(worst->piece, *plane)), measured(half(worst->piece, plane->turned()))};
      *worst = std::move(halves[0]);
      all.push_back(std::move(halves[1]));
    }
  }

  // Puts together again what two cuts have parted though it is near enough.
  void joinNeighbours(std::vector<MeasuredPiece>& all) const {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; j < all.size();) {
        std::optional<MeasuredPiece> both = joined(all[i].piece, all[j].piece);
        if (!both) {
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
  MeasuredPiece measured(CutPiece piece) const {
    const HullExcess excess = measure_.exactly(piece);
    return {std::move(piece), excess};
  }

  std::vector<HalfSpace> planesFor(const MeasuredPiece& piece) const {
    constexpr int kPlaces = 4;
    constexpr double kOblique = 0.1;
    const HullExcess& at = piece.excess;
    const Box bounds = boundsOf(piece.piece);
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
    return planes;
  }

  // None, if no plane cuts the piece.
  std::optional<HalfSpace> bestPlane(const MeasuredPiece& whole) const {
    constexpr double kOfBalance = 0.01;  // where planes leave the same, the halves are to be alike
    double best = std::numeric_limits<double>::infinity();
    std::optional<HalfSpace> best_plane;
    for (const HalfSpace& plane : planesFor(whole)) {
      const CutPiece one = half(whole.piece, plane), other = half(whole.piece, plane.turned());
      if (one.surface.empty() || other.surface.empty()) continue;
      const HullExcess here = measure_.roughly(one), there = measure_.roughly(other);
      const double uneven = std::abs(boundsOf(one).size().norm() - boundsOf(other).size().norm());
      const double score = here.air_m + there.air_m + kOfBalance * uneven;
      if (!(score < best)) continue;
      best = score;
      best_plane = plane;
    }
    return best_plane;
  }

  CutPiece half(const CutPiece& piece, const HalfSpace& plane) const {
    return {above(piece.surface, plane, rounding_m_)};
  }

  Box boundsOf(const CutPiece& piece) const {
    Box bounds;
    for (const Triangle3& triangle : piece.surface) {
      for (const Vec3& corner : triangle) bounds.extend(corner);
    }
    bounds.min.array() -= rounding_m_;
    bounds.max.array() += rounding_m_;
    return bounds;
  }

  // None, if it would be too far from its hull.
  std::optional<MeasuredPiece> joined(const CutPiece& a, const CutPiece& b) const {
    if (!boundsOf(a).meets(boundsOf(b))) return std::nullopt;
    CutPiece both = a;
    both.surface.insert(both.surface.end(), b.surface.begin(), b.surface.end());
    const HullExcess excess = measure_.exactly(both, rules_.allowed_m);
    if (excess.error_m > rules_.allowed_m) return std::nullopt;
    return MeasuredPiece{std::move(both), excess};
  }

  const CutSurface& surface_;
  const CutRules& rules_;
  PieceMeasure measure_;
  double rounding_m_ = 0;
};

}  // namespace

std::vector<NearPiece> cutPieces(const CutSurface& surface, const CutRules& rules) {
  constexpr int kMostRounds = 6;  // what is joined leaves room for cuts
  const Cutter cutter(surface, rules);
  std::vector<MeasuredPiece> measured = cutter.whole();
  for (int i = 0; i < kMostRounds && cutter.needsCut(measured); ++i) {
    cutter.cut(measured);
    cutter.joinNeighbours(measured);
  }
  std::vector<NearPiece> pieces;
  pieces.reserve(measured.size());
  for (MeasuredPiece& one : measured) pieces.push_back({std::move(one.piece), one.excess.error_m});
  return pieces;
}

}  // namespace hl
