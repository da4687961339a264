// R21, R22: how stiff a spring may be that presses on a free body, by theory, as two masses and in a session.
#include "tools/body_stability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace hl::test_body_stability {
namespace {

constexpr double kStiffness_N_m = 1000;

BodyOnDevice bodyOf(double body_kg, double damping_Ns_m = 0.5) {
  BodyOnDevice on;
  on.body_kg = body_kg;
  on.damping_Ns_m = damping_Ns_m;
  return on;
}

// The least damping of the device with which no swing grows, to 0.5 %.
template <typename Grows>
double leastDamping(double low, double high, Grows grows) {
  EXPECT_TRUE(grows(low)) << low;
  EXPECT_FALSE(grows(high)) << high;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (grows(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double leastOfTwoMasses(double body_kg, const Coupling& coupling, double about) {
  return leastDamping(0.5 * about, 2 * about, [&](double damping_Ns_m) {
    return swingGrows(bodyOf(body_kg, damping_Ns_m), coupling, kStiffness_N_m);
  });
}

double leastOfSession(double body_kg, double about) {
  return leastDamping(0.8 * about, 1.2 * about,
                      [&](double damping_Ns_m) { return swingGrows(bodyOf(body_kg, damping_Ns_m), kStiffness_N_m); });
}

// 75 g, 1 kHz: what the wall asks for is 0.500 N s/m.
TEST(BodyStability, R22ASessionIsStableWithTheDampingThatTheoryAsksFor) {
  EXPECT_NEAR(leastOfSession(1, 0.456), 0.456, 0.02 * 0.456);
  EXPECT_NEAR(leastOfSession(0.3, 0.312), 0.312, 0.02 * 0.312);
  EXPECT_NEAR(leastOfSession(1e6, 0.5), 0.5, 0.02 * 0.5);
}

TEST(BodyStability, R22LightBodiesAskForNoDampingInASession) {
  for (const double body_kg : {0.1, 0.03, 0.01, 0.001, 1e-6})
    EXPECT_FALSE(swingGrows(bodyOf(body_kg, 1e-6), kStiffness_N_m)) << body_kg;
}

TEST(BodyStability, R22TwoMassesSwingAsASessionDoes) {
  for (const double body_kg : {1.0, 0.3}) {
    const double theory = leastDamping_Ns_m(bodyOf(body_kg), kOneSolve, kStiffness_N_m);
    EXPECT_NEAR(leastOfTwoMasses(body_kg, kOneSolve, theory), theory, 0.02 * theory) << body_kg;
    EXPECT_NEAR(leastOfTwoMasses(body_kg, kOneSolve, theory), leastOfSession(body_kg, theory), 0.015 * theory);
  }
  for (const double body_kg : {0.1, 0.03, 0.01, 0.001})
    EXPECT_FALSE(swingGrows(bodyOf(body_kg, 1e-6), kOneSolve, kStiffness_N_m)) << body_kg;
}

TEST(BodyStability, R22WithTheForceOfTheBeginLightBodiesAskForALotOfDamping) {
  constexpr std::array<std::pair<double, double>, 5> kTable{
      {{1.0, 0.537}, {0.3, 0.625}, {0.1, 0.876}, {0.03, 1.76}, {0.01, 4.32}}};
  for (const auto& [body_kg, damping] : kTable) {
    EXPECT_NEAR(leastOfTwoMasses(body_kg, kForceBefore, damping), damping, 0.02 * damping) << body_kg;
    EXPECT_NEAR(leastDamping_Ns_m(bodyOf(body_kg), kForceBefore, kStiffness_N_m), damping, 0.02 * damping) << body_kg;
  }
}

TEST(BodyStability, R22WithTheForceOfTheStepBeforeNoDampingHelpsALightBody) {
  EXPECT_NEAR(leastOfTwoMasses(1, kForceOneLate, 0.617), 0.617, 0.02 * 0.617);
  EXPECT_NEAR(leastOfTwoMasses(0.3, kForceOneLate, 0.936), 0.936, 0.02 * 0.936);
  EXPECT_NEAR(leastOfTwoMasses(0.1, kForceOneLate, 2.2), 2.2, 0.02 * 2.2);
  for (const double body_kg : {0.03, 0.01, 0.001}) {
    for (double damping = 0.05; damping < 400; damping *= 1.3)
      EXPECT_TRUE(swingGrows(bodyOf(body_kg, damping), kForceOneLate, kStiffness_N_m)) << body_kg << " " << damping;
  }
}

TEST(BodyStability, TheHighestStiffnessIsThatOfTheory) {
  EXPECT_NEAR(highestStiffnessOnBody_N_m(bodyOf(0.1), kForceBefore), 571, 0.02 * 571);
  EXPECT_NEAR(highestStiffnessOnBody_N_m(bodyOf(0.1), kForceOneLate), 228, 0.02 * 228);
  EXPECT_NEAR(highestStiffnessOnBody_N_m(bodyOf(0.01), kForceOneLate), 7, 0.05 * 7);
  EXPECT_NEAR(mostStiffness_N_m(bodyOf(0.1), {0.5, 0}), 2286, 1);
  EXPECT_TRUE(std::isinf(mostStiffness_N_m(bodyOf(0.1), kOneSolve)));
}

// The body alone on a device that does not move: stable from K T^2 / 4 = 0.25 g on.
TEST(BodyStability, R21WithTheForceOfTheBeginABodyOfLessThanAQuarterGramLeavesAFingerThatIsHeld) {
  const auto grows = [](double body_kg, double theta) {
    BodyOnDevice held = bodyOf(body_kg);
    held.device_kg = 1e12;
    return swingGrows(held, {theta, 0}, kStiffness_N_m);
  };
  EXPECT_FALSE(grows(0.26e-3, 0));
  EXPECT_TRUE(grows(0.24e-3, 0));
  EXPECT_FALSE(grows(1e-9, 0.5));
  EXPECT_FALSE(grows(1e-9, 1));
}

}  // namespace
}  // namespace hl::test_body_stability
