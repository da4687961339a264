#include "bodies/free_motion.h"

#include "base/plain_math.h"

namespace hl {

namespace {

// In a step; beyond it a direction is no longer exact.
constexpr double kMostTurn_rad = 1e6;

// The rotation by |turn| rad about its direction.
Eigen::Quaterniond exponential(const Vec3& whole_turn) {
  const Vec3 turn = limited(whole_turn, kMostTurn_rad);
  const double angle = turn.norm();
  if (!(angle > 0)) return Eigen::Quaterniond::Identity();
  const Vec3 axis = plain::sin(angle / 2) / angle * turn;
  return {plain::cos(angle / 2), axis.x(), axis.y(), axis.z()};
}

}  // namespace

// In the frame of the body, with the angular momentum L of the world: w = I^-1 R^T L. The step turns by T (w0 + w1) /
// 2, w1 that of its end; so it is the same backward, and its energy does not drift. Three rounds of substitution leave
// an error of the fourth power of T |w|.
void moveFreely(const Body& body, BodyState& state, const Vec3& way, double period_s) {
  constexpr int kRounds = 4;
  state.centre += way;
  const Mat3& inertia = body.mass.inertia_kg_m2;
  const Mat3 inverse = inertia.inverse();
  const Mat3 rotation = state.turned.toRotationMatrix();
  const Vec3 before = rotation.transpose() * state.spin;
  const Vec3 momentum = rotation * (inertia * before);
  Vec3 after = before;
  Eigen::Quaterniond turned = state.turned;
  for (int round = 0; round < kRounds; ++round) {
    turned = (state.turned * exponential(period_s / 2 * (before + after))).normalized();
    const Vec3 last = after;
    after = inverse * (turned.toRotationMatrix().transpose() * momentum);
    if (after == last) break;
  }
  state.turned = turned;
  state.spin = turned.toRotationMatrix() * after;
}

}  // namespace hl
