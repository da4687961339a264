// Derivation. Let plane j be active. y0 = goal + (c_j - n_j.goal) n_j is the nearest point on it. Another plane a
// intersects plane j in a line. Write n_a = s n_j + u with s = +-1, the sign of n_a.n_j. The component of n_a within
// plane j is
//   m_a = u - (u.n_j) n_j,          and for x = y0 + z on plane j:   n_a.x >= c_a   <=>   m_a.z >= c_a - s c_j - u.y0.
// For nearly parallel planes u is small and exact (Sterbenz), so m_a and the right side keep their relative precision;
// 1 - (n_a.n_j)^2 and c_a - n_a.y0 would lose it. The same step again, within plane j, gives the corner of three
// planes.
#include "proxy/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "proxy/tolerances.h"

namespace hl {

namespace {

using ActiveSet = std::array<std::size_t, 3>;

struct Candidate {
  Vec3 point = Vec3::Zero();
  ActiveSet active{};
  std::size_t count = 0;
};

// The line in which plane a intersects plane j: normal . z = offset for x = origin + z; unit normal within plane j.
struct Line {
  Vec3 normal;
  double offset;
};

// Nothing for parallel planes.
std::optional<Line> cut(const Plane& j, const Plane& a, const Vec3& origin) {
  const double s = a.normal.dot(j.normal) < 0 ? -1.0 : 1.0;
  const Vec3 u = a.normal - s * j.normal;
  const Vec3 m = u - u.dot(j.normal) * j.normal;
  const double length = m.norm();
  if (length < accuracy::kParallel) return std::nullopt;
  return Line{m / length, (a.offset - s * j.offset - u.dot(origin)) / length};
}

// Intersection of two lines of plane j, relative to their origin. Nothing for parallel ones.
std::optional<Vec3> crossing(const Line& a, const Line& b, const Vec3& plane_normal) {
  const Vec3 along = plane_normal.cross(a.normal);
  const double s = b.normal.dot(a.normal) < 0 ? -1.0 : 1.0;
  const Vec3 w = b.normal - s * a.normal;
  const double sine = w.dot(along);
  if (std::abs(sine) < accuracy::kParallel) return std::nullopt;
  const Vec3 foot = a.offset * a.normal;
  return foot + ((b.offset - s * a.offset - w.dot(foot)) / sine) * along;
}

// Solves d = sum lambda_i n_i for the normals of a set by cross products (Cramer's rule), accurate also for nearly
// parallel normals.
std::array<double, 3> multipliersOf(std::span<const Plane> planes, const ActiveSet& set, std::size_t count,
                                    const Vec3& d) {
  const auto n = [&](std::size_t i) -> const Vec3& { return planes[set[i]].normal; };
  if (count == 1) return {d.dot(n(0)), 0, 0};
  if (count == 2) {
    const Vec3 e = n(0).cross(n(1));
    return {d.cross(n(1)).dot(e) / e.squaredNorm(), n(0).cross(d).dot(e) / e.squaredNorm(), 0};
  }
  if (count == 3) {
    const double det = n(0).dot(n(1).cross(n(2)));
    return {d.dot(n(1).cross(n(2))) / det, d.dot(n(2).cross(n(0))) / det, d.dot(n(0).cross(n(1))) / det};
  }
  return {};
}

double smallestMultiplier(std::span<const Plane> planes, const Candidate& candidate, const Vec3& goal) {
  const auto lambda = multipliersOf(planes, candidate.active, candidate.count, candidate.point - goal);
  return *std::min_element(lambda.begin(), lambda.begin() + static_cast<std::ptrdiff_t>(candidate.count));
}

double worstViolation(std::span<const Plane> planes, const ActiveSet& set, std::size_t count, const Vec3& x) {
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) worst = std::max(worst, planes[set[i]].offset - planes[set[i]].normal.dot(x));
  return worst;
}

// Keeps the best candidate: feasible before infeasible, then nearest (or, if infeasible, least violation). If more
// planes than needed meet in one point, several sets give that point: the set with the largest smallest multiplier is
// kept.
class Best {
 public:
  Best(std::span<const Plane> planes, const ActiveSet& basis, std::size_t count, const Vec3& goal, double tolerance)
      : planes_(planes), basis_(basis), count_(count), goal_(goal), tolerance_(tolerance) {}

  void offer(const Candidate& candidate) {
    const double violation = worstViolation(planes_, basis_, count_, candidate.point);
    const bool feasible = violation <= tolerance_;
    const double cost = feasible ? (candidate.point - goal_).squaredNorm() : violation;
    if (feasible == feasible_ ? isBetter(candidate, cost) : feasible) {
      feasible_ = feasible;
      cost_ = cost;
      best_ = candidate;
    }
  }
  const Candidate& candidate() const { return best_; }

 private:
  bool isBetter(const Candidate& candidate, double cost) const {
    const bool same_point =
        best_.count > 0 && (candidate.point - best_.point).norm() <= accuracy::kSamePoint * tolerance_;
    if (!same_point) return cost < cost_;
    return smallestMultiplier(planes_, candidate, goal_) > smallestMultiplier(planes_, best_, goal_);
  }

  std::span<const Plane> planes_;
  const ActiveSet& basis_;
  std::size_t count_;
  const Vec3& goal_;
  double tolerance_;
  Candidate best_;
  bool feasible_ = false;
  double cost_ = std::numeric_limits<double>::infinity();
};

// The optimum over the planes of `basis` and plane j, which is active: all subsets that contain j are tried.
Candidate solveWith(std::span<const Plane> planes, const ActiveSet& basis, std::size_t count, std::size_t j,
                    const Vec3& goal, double tolerance) {
  const Plane& plane = planes[j];
  const Vec3 origin = goal + (plane.offset - plane.normal.dot(goal)) * plane.normal;
  if (count == 0) return {origin, {j, 0, 0}, 1};
  Best best(planes, basis, count, goal, tolerance);
  best.offer({origin, {j, 0, 0}, 1});
  std::array<std::optional<Line>, 3> lines;
  for (std::size_t i = 0; i < count; ++i) {
    lines[i] = cut(plane, planes[basis[i]], origin);
    if (lines[i]) best.offer({origin + lines[i]->offset * lines[i]->normal, {j, basis[i], 0}, 2});
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      if (!lines[i] || !lines[k]) continue;
      if (const std::optional<Vec3> z = crossing(*lines[i], *lines[k], plane.normal))
        best.offer({origin + *z, {j, basis[i], basis[k]}, 3});
    }
  }
  return best.candidate();
}

std::size_t mostViolated(std::span<const Plane> planes, const Vec3& x, double& violation) {
  std::size_t worst = planes.size();
  violation = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double v = planes[i].offset - planes[i].normal.dot(x);
    if (v > violation) {
      violation = v;
      worst = i;
    }
  }
  return worst;
}

// One plane, the usual case: the projection onto it.
SolverResult nearestAboveOne(const Plane& plane, const Vec3& goal, double strict) {
  SolverResult result;
  result.rounds = 1;
  const double below = plane.offset - plane.normal.dot(goal);
  const bool active = below > strict;
  result.point = active ? Vec3(goal + below * plane.normal) : goal;
  result.active_count = active ? 1 : 0;
  result.multiplier[0] = active ? below : 0;
  result.violation = std::max(0.0, active ? plane.offset - plane.normal.dot(result.point) : below);
  return result;
}

}  // namespace

SolverResult nearestAbove(std::span<const Plane> planes, const Vec3& goal, double tolerance) {
  const double strict = accuracy::kStrictPerTolerance * tolerance;
  SolverResult result;
  result.point = goal;
  if (planes.empty()) return result;
  if (planes.size() == 1) {
    const SolverResult one = nearestAboveOne(planes[0], goal, strict);
    if (one.violation <= strict) return one;
  }
  while (true) {
    const std::size_t j = mostViolated(planes, result.point, result.violation);
    ++result.rounds;
    if (j == planes.size() || result.violation <= strict || result.rounds > convergence::kMaxSolverRounds) break;
    const Candidate next = solveWith(planes, result.active, result.active_count, j, goal, strict);
    // A real violation moves the optimum away from the goal, with multipliers >= 0. A violation caused by rounding
    // (planes that almost contradict or repeat each other) must not change the active set.
    const double distance = (next.point - goal).norm();
    const bool progress = distance > (result.point - goal).norm();
    if (!progress && result.violation <= tolerance) break;
    if (smallestMultiplier(planes, next, goal) < -accuracy::kNegative * distance) break;
    result.point = next.point;
    result.active = next.active;
    result.active_count = next.count;
  }
  result.multiplier = multipliersOf(planes, result.active, result.active_count, result.point - goal);
  return result;
}

}  // namespace hl
