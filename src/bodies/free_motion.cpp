#include "bodies/free_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Jacobi>

#include "base/plain_math.h"

namespace hl {

namespace {

// In a step; beyond it a direction is no longer exact.
constexpr double kMaxTurn_rad = 1e6;
// rad: what a part of the step turns at most, of a body whose moments all differ; and how many parts a step has.
constexpr double kTurnOfPart_rad = 0.01;
constexpr double kMaxPartsOfStep = 16;

// Jacobi's method: a pair of axes is turned until their product of inertia is nothing, again and again.
Mat3 diagonalized(Mat3& inertia) {
  constexpr int kSweeps = 10;
  Mat3 axes = Mat3::Identity();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      Eigen::JacobiRotation<double> rotation;
      if (!rotation.makeJacobi(inertia, p, q)) continue;
      inertia.applyOnTheLeft(p, q, rotation.adjoint());
      inertia.applyOnTheRight(p, q, rotation);
      axes.applyOnTheRight(p, q, rotation);
    }
  }
  return axes;
}

// About an axis of the body, by its momentum along that axis times `per_momentum`.
struct AxisTurn {
  int axis = 0;
  double per_momentum = 0;
};

// A turning body, seen along its principal axes.
struct Turning {
  Vec3 momentum;                                               // kg m^2 rad/s, along the axes as they are now
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();  // since the begin

  // A part of the turn; what the momentum is in the world stays.
  void turn(const AxisTurn& turn, double part = 1) {
    const Vec3 by_rad = part * turn.per_momentum * momentum[turn.axis] * Vec3::Unit(turn.axis);
    const Eigen::Quaterniond by = rotationBy(by_rad);
    turned = turned * by;
    momentum = by.conjugate() * momentum;
  }
};

// With the momentum L along the principal axes, and moments I1 <= I2 <= I3, the kinetic energy is
//
//   |L|^2 / 2 I2  +  (1/I1 - 1/I2) L1^2 / 2  +  (1/I3 - 1/I2) L3^2 / 2.
//
// Each term alone is a steady turn: the first about L, the others about an axis of the body. The first goes with both
// others; for these the step is halved about the one that turns the body more (Strang's splitting; R. I. McLachlan,
// Explicit Lie-Poisson integration and the Euler equations, Physical Review Letters 71, 1993). A body with two equal
// moments has one of them alone. The result is the turn about the axes of the body, without that about L.
Eigen::Quaterniond turnAboutAxes(const Vec3& inverse_moments, const Vec3& momentum, double period_s) {
  const double first = inverse_moments[0] - inverse_moments[1], third = inverse_moments[2] - inverse_moments[1];
  const double mixed_rad = period_s * momentum.norm() * std::sqrt(-first * third);
  const double parts = std::clamp(std::ceil(mixed_rad / kTurnOfPart_rad), 1.0, kMaxPartsOfStep);
  AxisTurn more{0, period_s / parts * first}, less{2, period_s / parts * third};
  if (first < -third) std::swap(more, less);
  Turning turning{momentum};
  turning.turn(more, 0.5);
  for (double part = 1; part < parts; ++part) {
    turning.turn(less);
    turning.turn(more);
  }
  turning.turn(less);
  turning.turn(more, 0.5);
  return turning.turned;
}

}  // namespace

Eigen::Quaterniond rotationBy(const Vec3& whole_turn_rad) {
  const Vec3 turn = limited(whole_turn_rad, kMaxTurn_rad);
  const double angle = turn.norm();
  if (!(angle > 0)) return Eigen::Quaterniond::Identity();
  const Vec3 axis = plain::sin(angle / 2) / angle * turn;
  return {plain::cos(angle / 2), axis.x(), axis.y(), axis.z()};
}

PrincipalAxes principalAxesOf(const Mass& mass) {
  Mat3 inertia = mass.inertia_kg_m2;
  const Mat3 axes = diagonalized(inertia);
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return inertia(x, x) < inertia(y, y); });
  Mat3 sorted;
  PrincipalAxes principal;
  for (int i = 0; i < 3; ++i) {
    const int from = order[static_cast<std::size_t>(i)];
    sorted.col(i) = axes.col(from);
    principal.moments_kg_m2[i] = inertia(from, from);
  }
  if (sorted.determinant() < 0) sorted.col(2) *= -1;
  principal.axes = Eigen::Quaterniond(sorted);
  return principal;
}

void moveFreely(const PrincipalAxes& body, BodyState& state, const Vec3& way, double period_s) {
  state.centre += way;
  const Vec3 inverse = body.moments_kg_m2.cwiseInverse();
  const Eigen::Quaterniond from_axes = state.turned * body.axes;
  const Vec3 momentum_along = body.moments_kg_m2.cwiseProduct(from_axes.conjugate() * state.spin);
  const Vec3 momentum = from_axes * momentum_along;
  const Eigen::Quaterniond about_axes = turnAboutAxes(inverse, momentum_along, period_s);
  const Eigen::Quaterniond about_momentum = rotationBy(period_s * inverse[1] * momentum);
  state.turned = (about_momentum * state.turned * (body.axes * about_axes * body.axes.conjugate())).normalized();
  const Eigen::Quaterniond to_world = state.turned * body.axes;
  state.spin = to_world * inverse.cwiseProduct(to_world.conjugate() * momentum);
}

}  // namespace hl
