// PHANToM model: kinematics against finite differences, mass matrix, and what the published parameters mean at the tip.
#include "device/phantom.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace hl::test_phantom {
namespace {

const PhantomParameters kArm;

/// Joints inside the limits, those of the fold too.
Vec3 randomJoints(std::mt19937& random) {
  while (true) {
    Vec3 q;
    for (int i = 0; i < 3; ++i) q[i] = std::uniform_real_distribution<>(kArm.q_min[i], kArm.q_max[i])(random);
    const double fold = q.z() - q.y();
    if (fold > kArm.q3_less_q2_min && fold < kArm.q3_less_q2_max) return q;
  }
}

Vec3 randomRates(std::mt19937& random) {
  std::uniform_real_distribution<> rate(-5, 5);  // rad/s: about 1 m/s at the tip
  return {rate(random), rate(random), rate(random)};
}

/// Mass felt at the tip along each axis, kg.
Vec3 tipInertia_kg(const PhantomParameters& arm, const Vec3& q) {
  const Mat3 j = phantomJacobian(arm, q);
  return (j * phantomMass(arm, q).inverse() * j.transpose()).diagonal().cwiseInverse();
}

TEST(Phantom, JacobianIsTheDerivativeOfTheTip) {
  std::mt19937 random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 q = randomJoints(random);
    for (int i = 0; i < 3; ++i) {
      const Vec3 h = 1e-6 * Vec3::Unit(i);
      const Vec3 difference = (phantomTip(kArm, q + h) - phantomTip(kArm, q - h)) / 2e-6;
      EXPECT_LT((difference - phantomJacobian(kArm, q).col(i)).norm(), 1e-9);  // rounding over the step
    }
  }
}

TEST(Phantom, JointsPutTheTipWhereItWasAskedFor) {
  std::mt19937 random(2);
  std::uniform_real_distribution<> x(0.1, 0.27), yz(-0.1, 0.1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 tip(x(random), yz(random), yz(random));
    Vec3 q;
    ASSERT_TRUE(phantomJoints(kArm, tip, q));
    EXPECT_LT((phantomTip(kArm, q) - tip).norm(), 1e-12);
  }
  Vec3 q;
  EXPECT_FALSE(phantomJoints(kArm, Vec3(0.4, 0, 0), q));
}

TEST(Phantom, MassMatrixIsSymmetricPositiveDefinite) {
  std::mt19937 random(3);
  for (int n = 0; n < 10000; ++n) {
    const Mat3 mass = phantomMass(kArm, randomJoints(random));
    EXPECT_EQ(mass, mass.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(mass).eigenvalues().minCoeff(), 1e-4);
  }
}

// Lagrange: C q' = M' q' - grad(q'^T M q' / 2).
TEST(Phantom, CoriolisIsThatOfTheMassMatrix) {
  std::mt19937 random(4);
  constexpr double kStep = 1e-5;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 q = randomJoints(random), rate = randomRates(random);
    Mat3 change = Mat3::Zero();
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const Vec3 h = kStep * Vec3::Unit(i);
      const Mat3 derivative = (phantomMass(kArm, q + h) - phantomMass(kArm, q - h)) / (2 * kStep);
      change += derivative * rate[i];
      gradient[i] = 0.5 * rate.dot(derivative * rate);
    }
    EXPECT_LT((phantomCoriolis(kArm, q, rate) - (change * rate - gradient)).norm(), 1e-8);
  }
}

// science 4.1: 32, 77 and 53 g, with rotors 37, 81 and 55 g.
TEST(Phantom, TipInertiaIsThePublishedOne) {
  PhantomParameters links;
  links.with_rotors = false;
  const Vec3 without = tipInertia_kg(links, Vec3::Zero()), with = tipInertia_kg(kArm, Vec3::Zero());
  const Vec3 expected_without(0.032, 0.077, 0.053), expected_with(0.037, 0.081, 0.055);
  RecordProperty("tip_inertia_g", testing::PrintToString((1000 * with).transpose()));
  EXPECT_LT((without - expected_without).cwiseAbs().maxCoeff(), 0.0006) << without.transpose();  // the digits printed
  EXPECT_LT((with - expected_with).cwiseAbs().maxCoeff(), 0.0006) << with.transpose();
}

TEST(Phantom, TipFrictionDampingForceAndResolutionAreThePublishedOnes) {
  for (int i = 0; i < 3; ++i) {
    const double arm_m = phantomJacobian(kArm, Vec3::Zero()).col(i).norm();
    const double friction_N = kArm.joint_friction_Nm / arm_m;
    EXPECT_GT(friction_N, 0.046);
    EXPECT_LT(friction_N, 0.0595);
    const double damping_Ns_m = kArm.joint_damping_Nms / (arm_m * arm_m);
    EXPECT_GT(damping_Ns_m, 0.0105);
    EXPECT_LT(damping_Ns_m, 0.0175);
    const double resolution_m = arm_m * 2 * M_PI / (kArm.encoder_counts * kArm.gear[i]);
    EXPECT_GT(resolution_m, 23.5e-6);
    EXPECT_LT(resolution_m, 30.5e-6);
  }
  EXPECT_NEAR(kArm.motor_torque_peak_Nm * kArm.gear.z() / kArm.l2, 8.5, 0.005);
}

TEST(Phantom, FrictionTakesEnergyAndNeverDrivesAJoint) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> exponent(-8, 1);
  constexpr double kStep_s = 1e-5;
  for (int n = 0; n < 20000; ++n) {
    const Mat3 mass = phantomMass(kArm, randomJoints(random));
    const Vec3 before = randomRates(random) * std::pow(10, exponent(random));
    Vec3 impulse = 1e-7 * randomRates(random);
    const Vec3 after = phantomFriction(kArm, mass, before, kStep_s, impulse);
    EXPECT_LE(impulse.cwiseAbs().maxCoeff(), kArm.joint_friction_Nm * kStep_s);
    EXPECT_LE(after.dot(mass * after), before.dot(mass * before) * (1 + 1e-12));
    // What is left of the iteration: 1e-6 rad/s is less than one encoder count in two minutes.
    for (int i = 0; i < 3; ++i) EXPECT_LE(impulse[i] * after[i], 1e-6 * std::abs(impulse[i]));
  }
}

TEST(Phantom, StopsPushBackOnlyBeyondTheLimits) {
  std::mt19937 random(6);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 q = randomJoints(random);
    EXPECT_EQ(phantomStops(kArm, q, randomRates(random)), Vec3(Vec3::Zero()));
    EXPECT_EQ(phantomStopEnergy_J(kArm, q), 0);
  }
  EXPECT_LT(phantomStops(kArm, Vec3(1.7, 0, 0), Vec3::Zero()).x(), 0);
  const Vec3 folded = phantomStops(kArm, Vec3(0, 1.2, 0), Vec3::Zero());
  EXPECT_LT(folded.y(), 0);
  EXPECT_EQ(folded.y(), -folded.z());
}

}  // namespace
}  // namespace hl::test_phantom
