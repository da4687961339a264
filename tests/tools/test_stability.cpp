// What the stability bench finds, against theory and against what the simulated PHANToM must do.
#include "tools/stability.h"

#include <gtest/gtest.h>

namespace hl::test_stability {
namespace {

StabilityCase linear(double mass_kg, double damping_Ns_m, double rate_Hz, int delay) {
  StabilityCase loop;
  loop.device.model = linearDevice(mass_kg, damping_Ns_m);
  loop.device.held = false;
  loop.device.delay_steps = delay;
  loop.rate_Hz = rate_Hz;
  return loop;
}

// Gil, Sanchez and Hulin 2009: b = K (T/2 + d T), of a device without friction, encoder steps or hand.
TEST(C60Stability, TheLinearDeviceTurnsUnstableWhereTheorySays) {
  for (const int delay : {0, 1, 2}) {
    const double theory_N_m = 0.5 / (1e-3 * (0.5 + delay));
    const double found_N_m = criticalStiffness_N_m(linear(0.075, 0.5, 1000, delay), 0.5 * theory_N_m, 2 * theory_N_m);
    EXPECT_NEAR(found_N_m, theory_N_m, 0.02 * theory_N_m) << delay;
  }
  const double theory_N_m = 0.5 / (0.25e-3 * 0.5);
  EXPECT_NEAR(criticalStiffness_N_m(linear(0.075, 0.5, 4000, 0), 0.5 * theory_N_m, 2 * theory_N_m), theory_N_m,
              0.02 * theory_N_m);
}

StabilityCase phantom(double rate_Hz, bool firm, int delay = 0) {
  StabilityCase loop;
  loop.device.model = premium10();
  loop.device.firm = firm;
  loop.device.delay_steps = delay;
  loop.rate_Hz = rate_Hz;
  return loop;
}

TEST(C63Stability, TheStiffnessOfThePaperSettlesInBothGrips) {
  EXPECT_TRUE(settles(phantom(1000, false), 1800, Landings::kTogether));
  EXPECT_TRUE(settles(phantom(1000, true), 1800, Landings::kTogether));
}

TEST(Stability, ThePhantomSettlesAsStiffAsItMust) {
  EXPECT_TRUE(settles(phantom(1000, false), 2400, Landings::kOneByOne));
  EXPECT_TRUE(settles(phantom(1000, true), 5300, Landings::kOneByOne));
  EXPECT_TRUE(settles(phantom(4000, false), 10'000, Landings::kOneByOne));
}

TEST(Stability, OneStepOfDelayLosesThePapersStiffnessInALightGripAndTwoInAFirmOne) {
  EXPECT_FALSE(settles(phantom(1000, false, 1), 1800, Landings::kOneByOne));
  EXPECT_FALSE(settles(phantom(1000, false, 2), 1800, Landings::kOneByOne));
  EXPECT_FALSE(settles(phantom(1000, true, 2), 1800, Landings::kOneByOne));
}

TEST(Stability, TheSameCaseGivesTheSameBits) {
  const Landing landing{0.15, 1};
  StabilityCase loop = phantom(1000, false);
  loop.device.jitter_s = 50e-6;
  loop.device.bends = true;
  loop.device.current_lag_s = 0.25e-3;
  EXPECT_EQ(restlessness_m(loop, 1500, landing), restlessness_m(loop, 1500, landing));
}

}  // namespace
}  // namespace hl::test_stability
