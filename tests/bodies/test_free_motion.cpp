// How a body turns when nothing touches it.
#include "bodies/free_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "draws.h"

namespace hl::test_free_motion {
namespace {

constexpr double kStep_s = 1e-3;

Eigen::Quaterniond poseOfDraw(test::Draws& draws) {
  const double angle = draws.between(0, 3);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, draws.direction()));
}

Mass turnedMass(const Vec3& moments, const Eigen::Quaterniond& axes) {
  Mass mass;
  const Mat3 rotation = axes.toRotationMatrix();
  mass.inertia_kg_m2 = rotation * moments.asDiagonal() * rotation.transpose();
  return mass;
}

Mat3 inertiaIn(const Mass& mass, const BodyState& state) {
  const Mat3 rotation = state.turned.toRotationMatrix();
  return rotation * mass.inertia_kg_m2 * rotation.transpose();
}

double energy_J(const Mass& mass, const BodyState& state) {
  return state.spin.dot(inertiaIn(mass, state) * state.spin) / 2;
}

// Euler's equations by small steps of Runge and Kutta: the judge.
BodyState turnedInSmallSteps(const Mass& mass, BodyState state, double time_s, int steps) {
  const Mat3 inverse = mass.inertia_kg_m2.inverse();
  const Vec3 momentum = inertiaIn(mass, state) * state.spin;
  const auto rate = [&](const Eigen::Vector4d& pose) -> Eigen::Vector4d {
    const Eigen::Quaterniond turned(pose);
    const Vec3 spin = inverse * (turned.conjugate() * momentum);
    return (turned * Eigen::Quaterniond(0, spin.x() / 2, spin.y() / 2, spin.z() / 2)).coeffs();
  };
  Eigen::Vector4d pose = state.turned.coeffs();
  const double h = time_s / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d a = rate(pose), b = rate(pose + h / 2 * a), c = rate(pose + h / 2 * b),
                          d = rate(pose + h * c);
    pose = (pose + h / 6 * (a + 2 * b + 2 * c + d)).normalized();
  }
  state.turned.coeffs() = pose;
  state.spin = state.turned * (inverse * (state.turned.conjugate() * momentum));
  return state;
}

// All within one turn of a step: needles, plates, and what has three different moments.
TEST(FreeMotion, TurnsAsEulersEquationsSay) {
  test::Draws draws(1);
  for (int i = 0; i < 200; ++i) {
    const double thin = std::pow(10, draws.between(-4, 0)), other = draws.between(1, 1.2);
    const Vec3 moments(thin, other, other + draws.between(0, thin));
    const Mass mass = turnedMass(moments, poseOfDraw(draws));
    const PrincipalAxes axes = principalAxesOf(mass);
    BodyState state;
    state.turned = poseOfDraw(draws);
    state.spin = draws.between(0, 100) * draws.direction();
    BodyState moved = state;
    for (int step = 0; step < 10; ++step) moveFreely(axes, moved, Vec3::Zero(), kStep_s);
    const BodyState judged = turnedInSmallSteps(mass, state, 10 * kStep_s, 4000);
    EXPECT_LT(moved.turned.angularDistance(judged.turned), 1e-3) << moments.transpose();
    EXPECT_LT((moved.spin - judged.spin).norm(), 1e-3 * state.spin.norm()) << moments.transpose();
  }
}

// Half of the step, a quarter of the error.
TEST(FreeMotion, ErrsWithTheSquareOfTheStep) {
  const Mass mass = turnedMass(Vec3(1, 2, 2.6), Eigen::Quaterniond(1, 2, 3, 4).normalized());
  BodyState begun;
  begun.spin = Vec3(20, -30, 25);
  const BodyState judged = turnedInSmallSteps(mass, begun, 0.1, 20'000);
  const auto error = [&](int steps) {
    BodyState state = begun;
    for (int i = 0; i < steps; ++i) moveFreely(principalAxesOf(mass), state, Vec3::Zero(), 0.1 / steps);
    return state.turned.angularDistance(judged.turned);
  };
  EXPECT_NEAR(error(1000) / error(2000), 4, 0.1);
}

// The spin of a symmetric top goes round its momentum with |L| / I, and round its axis with (1 - I3 / I) of its spin
// about it (H. Goldstein, Classical Mechanics, section 5.6).
TEST(FreeMotion, OfASymmetricTopIsExactWhateverItsSpin) {
  for (const double moment_along : {1e-5, 0.1, 0.999, 1.0, 1.5, 2.0}) {
    const Mass mass = turnedMass(Vec3(1, moment_along, 1), Eigen::Quaterniond::Identity());
    const PrincipalAxes axes = principalAxesOf(mass);
    for (const double spin_rad_s : {1.0, 1e3, 1e5}) {
      BodyState state;
      state.spin = spin_rad_s * Vec3(0.6, 0.8, 0);
      const Vec3 momentum = inertiaIn(mass, state) * state.spin;
      const double along = state.spin.y(), energy = energy_J(mass, state);
      constexpr int kSteps = 1000;
      for (int i = 0; i < kSteps; ++i) moveFreely(axes, state, Vec3::Zero(), kStep_s);
      // The spin about a thin axis is the momentum along it over a small moment: so are the digits that are lost.
      const double rounding = 1e-12 / moment_along + 1e-10;
      EXPECT_NEAR((state.turned * Vec3::UnitY()).dot(state.spin), along, rounding * spin_rad_s);
      EXPECT_NEAR(energy_J(mass, state), energy, 1e-9 * energy);
      const double time_s = kSteps * kStep_s;
      const Eigen::AngleAxisd round_momentum(std::fmod(time_s * momentum.norm(), 2 * M_PI), momentum.normalized());
      const Vec3 axis = round_momentum * Vec3::UnitY();
      EXPECT_LT((state.turned * Vec3::UnitY() - axis).norm(), 1e-9 * (1 + spin_rad_s)) << moment_along;
    }
  }
}

// Rods of 0.1 mm by 30 mm that are thrown with a spin of 100 rad/s about any direction, for a minute.
TEST(FreeMotion, OfANeedleGainsNoEnergy) {
  test::Draws draws(2);
  for (int i = 0; i < 20; ++i) {
    const Mass mass = massOfBox(1e-3, Vec3(5e-5, draws.between(5e-5, 6e-5), 15e-3));
    const PrincipalAxes axes = principalAxesOf(mass);
    BodyState state;
    state.turned = poseOfDraw(draws);
    state.spin = 100 * draws.direction();
    const double energy = energy_J(mass, state);
    const Vec3 momentum = inertiaIn(mass, state) * state.spin;
    double most = energy, least = energy;
    for (int step = 0; step < 60'000; ++step) {
      moveFreely(axes, state, Vec3::Zero(), kStep_s);
      most = std::max(most, energy_J(mass, state));
      least = std::min(least, energy_J(mass, state));
    }
    EXPECT_LT(most, 1.001 * energy) << i;
    EXPECT_GT(least, 0.999 * energy) << i;
    EXPECT_LT((inertiaIn(mass, state) * state.spin - momentum).norm(), 1e-10 * momentum.norm()) << i;
  }
}

// Three different moments, turning by up to radians a step: the energy stays near what it was.
TEST(FreeMotion, OfAFastBodyKeepsItsEnergy) {
  test::Draws draws(3);
  for (int i = 0; i < 100; ++i) {
    const Mass mass = massOfBox(0.1, Vec3(draws.between(1, 30), draws.between(1, 30), draws.between(1, 30)) * 1e-3);
    const PrincipalAxes axes = principalAxesOf(mass);
    BodyState state;
    state.turned = poseOfDraw(draws);
    state.spin = draws.between(0, 1000) * draws.direction();
    const double energy = energy_J(mass, state);
    for (int step = 0; step < 10'000; ++step) {
      moveFreely(axes, state, Vec3::Zero(), kStep_s);
      ASSERT_NEAR(energy_J(mass, state), energy, 0.01 * energy) << i;
    }
  }
}

TEST(FreeMotion, PrincipalAxesMakeTheInertiaAgain) {
  test::Draws draws(4);
  for (int i = 0; i < 1000; ++i) {
    const double scale = std::pow(10, draws.between(-12, 0));
    const Vec3 moments =
        scale * Vec3(draws.between(1e-6, 1), draws.between(1e-6, 1), i % 3 == 0 ? 0.5 : draws.between(1e-6, 1));
    const Mass mass = turnedMass(moments, poseOfDraw(draws));
    const PrincipalAxes axes = principalAxesOf(mass);
    const Mass again = turnedMass(axes.moments_kg_m2, axes.axes);
    EXPECT_LT((again.inertia_kg_m2 - mass.inertia_kg_m2).norm(), 1e-14 * scale);
    EXPECT_LE(axes.moments_kg_m2[0], axes.moments_kg_m2[1]);
    EXPECT_LE(axes.moments_kg_m2[1], axes.moments_kg_m2[2]);
  }
}

TEST(FreeMotion, AtRestChangesNothing) {
  const PrincipalAxes axes = principalAxesOf(turnedMass(Vec3(3, 1, 2), Eigen::Quaterniond(1, 2, 3, 4).normalized()));
  BodyState state;
  state.turned = Eigen::Quaterniond(4, 3, -2, 1).normalized();
  const Eigen::Quaterniond turned = state.turned;
  for (int i = 0; i < 10'000; ++i) moveFreely(axes, state, Vec3::Zero(), kStep_s);
  EXPECT_LT(state.turned.angularDistance(turned), 1e-15);
  EXPECT_EQ(state.spin, Vec3::Zero());
}

}  // namespace
}  // namespace hl::test_free_motion
