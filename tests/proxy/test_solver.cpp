// C08, C09: the solver against two judges. The certificate: by duality, any multipliers >= 0 bound the optimum from
// below, so a feasible point whose objective meets that bound is optimal. The brute force: every set of at most three
// planes.
#include "proxy/solver.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "cases.h"

namespace hl::test_solver {
namespace {

using Real = long double;
using RVec = Eigen::Matrix<Real, 3, 1>;

constexpr double kTolerance = 4e-13;

RVec wide(const Vec3& v) { return v.cast<Real>(); }

// Objective minus its dual bound, both for |x - goal|: never negative but for rounding.
Real dualityGap(const std::vector<Plane>& planes, const Vec3& goal, const SolverResult& result) {
  RVec pull = RVec::Zero();
  Real linear = 0;
  for (std::size_t i = 0; i < result.active_count; ++i) {
    const Plane& plane = planes[result.active[i]];
    const Real lambda = std::max<Real>(0, result.multiplier[i]);
    pull += lambda * wide(plane.normal);
    linear += lambda * (Real(plane.offset) - wide(plane.normal).dot(wide(goal)));
  }
  const Real dual = linear - pull.squaredNorm() / 2;  // of 1/2 |x - goal|^2
  const Real primal = (wide(result.point) - wide(goal)).norm();
  return primal - std::sqrt(std::max<Real>(0, 2 * dual));
}

Real worst(const std::vector<Plane>& planes, const RVec& x) {
  Real violation = 0;
  for (const Plane& plane : planes) violation = std::max(violation, Real(plane.offset) - wide(plane.normal).dot(x));
  return violation;
}

// The smallest distance to the goal over all feasible candidates of at most three planes.
Real bruteForce(const std::vector<Plane>& planes, const Vec3& goal) {
  const RVec g = wide(goal);
  Real best = INFINITY;
  const auto offer = [&](const RVec& x) {
    if (x.allFinite() && worst(planes, x) <= 1e-12L) best = std::min(best, (x - g).norm());
  };
  offer(g);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const RVec ni = wide(planes[i].normal);
    const Real bi = planes[i].offset - ni.dot(g);
    offer(g + bi * ni / ni.squaredNorm());
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const RVec nj = wide(planes[j].normal);
      const Real bj = planes[j].offset - nj.dot(g);
      const RVec e = ni.cross(nj);
      offer(g + (bi * nj.cross(e) + bj * e.cross(ni)) / e.squaredNorm());
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const RVec nk = wide(planes[k].normal);
        const Real bk = planes[k].offset - nk.dot(g);
        offer(g + (bi * nj.cross(nk) + bj * nk.cross(ni) + bk * e) / e.dot(nk));
      }
    }
  }
  return best;
}

class Systems {
 public:
  // Normals may lean to each other by as little as 10^-digits.
  Systems(unsigned seed, double digits) : random_(seed), digits_(digits) {}

  // Up to `most` planes that all hold at the origin: generic, near one direction, nearly parallel, opposed, through 0.
  std::vector<Plane> planes(std::size_t most) {
    std::vector<Plane> planes(1 + random_() % most);
    const int style = static_cast<int>(random_() % 6);
    const Vec3 base = direction();
    const double spread = std::pow(10.0, -digits_ * uniform());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      Vec3 n = direction();
      if (style == 1) n = base + 0.7 * n;
      if (style == 2) n = base + spread * n;
      if (style == 3 && i > 0 && i % 2 == 1) n = planes[i - 1].normal + spread * n;
      // A wedge of angle a multiplies forces by 1/a: below 1e-3 the answer itself is not known to 1e-9.
      if (style == 4) n = (i % 2 == 0 ? base : Vec3(-base)) + std::max(spread, 1e-3) * n;
      planes[i] = {n.normalized(), style == 5 || random_() % 3 == 0 ? 0.0 : -0.3 * uniform() * uniform()};
    }
    return planes;
  }
  Vec3 goal() { return direction() * std::pow(10.0, 1 - 4 * uniform()); }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  std::mt19937 random_;
  double digits_;
};

// Whole numbers hit the special cases that random ones miss: equal and opposite planes, four planes through one point,
// a goal on a plane; and a failure shrinks to one that can be solved by hand.
RC_GTEST_PROP(C08Solver, EveryIntegerSystemAgreesWithBruteForce, ()) {
  const auto coordinate = rc::gen::inRange(-3, 4);
  const auto vec = [&] { return Vec3(*coordinate, *coordinate, *coordinate); };
  std::vector<Plane> planes;
  const int count = *rc::gen::inRange(1, 9);
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = vec();
    if (normal.isZero()) continue;
    planes.push_back({normal.normalized(), -0.25 * *rc::gen::inRange(0, 3)});  // all hold at the origin
  }
  const Vec3 goal = vec();
  const SolverResult result = nearestAbove(planes, goal, kTolerance);
  RC_ASSERT(worst(planes, wide(result.point)) <= 1e-9L);
  RC_ASSERT(std::abs((wide(result.point) - wide(goal)).norm() - bruteForce(planes, goal)) <= 1e-9L);
}

TEST(C08Solver, MillionRandomSystemsMeetTheDualBound) {
  Systems systems(1, 8);
  for (int i = 0; i < test::cases(1'000'000); ++i) {
    const std::vector<Plane> planes = systems.planes(16);
    const Vec3 goal = systems.goal();
    const SolverResult result = nearestAbove(planes, goal, kTolerance);
    ASSERT_LE(worst(planes, wide(result.point)), 1e-9L) << "system " << i;
    ASSERT_LE(dualityGap(planes, goal, result), 1e-9L) << "system " << i << " of " << planes.size();
  }
}

TEST(C08Solver, AgreesWithBruteForceOverAllSetsOfThree) {
  Systems systems(2, 2);  // the judge's own formulas lose digits beyond
  for (int i = 0; i < test::cases(100'000); ++i) {
    const std::vector<Plane> planes = systems.planes(12);
    const Vec3 goal = systems.goal();
    const SolverResult result = nearestAbove(planes, goal, kTolerance);
    ASSERT_NEAR(static_cast<double>((wide(result.point) - wide(goal)).norm()),
                static_cast<double>(bruteForce(planes, goal)), 1e-9)
        << "system " << i;
  }
}

// The vector on which the paper's hull of normals sticks dead: the exact answer slides along the groove.
TEST(C08Solver, SlidesAlongTheGrooveWhereTheHullTestSticks) {
  const double s = std::sin(M_PI / 3);
  const std::vector<Plane> planes{{Vec3(-s, 0, 0.5), 0}, {Vec3(s, 0, 0.5), 0}, {Vec3(0, 0.02, 1).normalized(), 0}};
  const Vec3 goal = Vec3(0, 0.53, -0.85).normalized();
  const Vec3 x = nearestAbove(planes, goal, kTolerance).point;
  EXPECT_NEAR(x.x(), 0, 1e-12);
  EXPECT_NEAR(x.y(), goal.y(), 1e-12);
  EXPECT_NEAR(x.z(), 0, 1e-12);
}

TEST(C09Solver, AtMostThreeActivePlanesWithMultipliersNotNegative) {
  Systems systems(3, 8);
  for (int i = 0; i < test::cases(100'000); ++i) {
    const std::vector<Plane> planes = systems.planes(16);
    const Vec3 goal = systems.goal();
    const SolverResult result = nearestAbove(planes, goal, kTolerance);
    ASSERT_LE(result.active_count, 3u);
    for (std::size_t k = 0; k < result.active_count; ++k) ASSERT_GE(result.multiplier[k], -1e-9);
  }
}

// Work counted as plane visits: rounds times planes. Rounds must not grow with the number of planes.
TEST(C09Solver, WorkIsLinearInTheNumberOfPlanes) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  double first = 0;
  double last = 0;
  for (int size = 16; size <= 4096; size *= 4) {
    double rounds = 0;
    for (int i = 0; i < 200; ++i) {
      std::vector<Plane> planes(static_cast<std::size_t>(size));
      for (Plane& plane : planes) {
        const Vec3 n(normal(random), normal(random), std::abs(normal(random)));
        plane = {n.normalized(), -std::abs(normal(random))};
      }
      rounds += static_cast<double>(nearestAbove(planes, Vec3(normal(random), normal(random), -9), kTolerance).rounds);
    }
    if (size == 16) first = rounds;
    last = rounds;
  }
  EXPECT_LE(std::log(last / first) / std::log(4096.0 / 16.0), 0.15);
}

TEST(Solver, WithoutPlanesTheGoalIsReached) {
  const SolverResult result = nearestAbove({}, Vec3(1, 2, 3), kTolerance);
  EXPECT_EQ(result.point, Vec3(1, 2, 3));
  EXPECT_EQ(result.active_count, 0u);
}

TEST(Solver, ContradictingPlanesAreReportedAsViolated) {
  const std::vector<Plane> planes{{Vec3::UnitX(), 1}, {-Vec3::UnitX(), 1}};
  EXPECT_GT(nearestAbove(planes, Vec3::Zero(), kTolerance).violation, 0.5);
}

TEST(Solver, PlanesTiltedByATenMillionthAreBothKept) {
  const double tilt = 1e-7;
  const std::vector<Plane> planes{{Vec3::UnitZ(), 0}, {Vec3(-std::sin(tilt), 0, std::cos(tilt)), 0}};
  const SolverResult result = nearestAbove(planes, Vec3(1e-3, 0, -0.02), 1e-15);
  // Beyond the fold the second plane is above the first: the step climbs it.
  EXPECT_NEAR(result.point.x(), 1e-3, 1e-8);
  EXPECT_GE(result.point.z(), 0.99e-10);
}

}  // namespace
}  // namespace hl::test_solver
