// The passivity guard on loops that feed energy: without it they swing up to the limit of the force, with it the swing
// stays what it was at first. And on one that feeds none: there it does nothing.
#include "control/passivity_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "control/servo.h"

namespace hl::test_passivity_guard {
namespace {

constexpr double kPeriod_s = 1e-3;

struct Loop {
  double mass_kg = 0.1;
  double stiffness_N_m = 2000;
  int delay_steps = 2;  // of the floor: the proxy is that of an older finger
  bool guard = false;
};

struct Swing {
  double first_m_s = 0;  // fastest in the first tenth of a second
  double last_m_s = 0;   // fastest in the last second of ten
  double dissipated_J = 0;
};

// A mass without any friction, pressed on the floor y = 0 with half a newton, from a little above. The semi-implicit
// Euler steps are fine against the period of the swing.
Swing press(const Loop& loop) {
  ServoSettings settings;
  settings.stiffness_N_m = loop.stiffness_N_m;
  settings.force_limit_N = 8;
  settings.force_rate_limit_N_s = 20'000;
  settings.velocity_limit_m_s = 100;
  settings.ramp_s = kPeriod_s;
  settings.ledger = LedgerMode::kReport;  // the hand-over must not mend what the guard is to mend
  settings.passivity.on = loop.guard;
  settings.vibration.on = false;
  ServoState state;
  arm(state);
  double y = 0.001, v = 0;
  std::deque<double> proxies;
  Swing swing;
  for (std::int64_t i = 1; i <= 10'000; ++i) {
    DeviceSample sample;
    sample.time_ns = i * 1'000'000;
    sample.position = Vec3(0, y, 0);
    sample.status = DeviceStatus::kOk;
    proxies.push_back(y);
    if (static_cast<int>(proxies.size()) > loop.delay_steps + 1) proxies.pop_front();
    // The floor pulls up by how deep the finger was then: an active spring.
    const double depth = std::max(0.0, -proxies.front());
    const Vec3 proxy = sample.position + Vec3(0, depth, 0);
    const Vec3 force_N = stepServo(state, settings, {proxy, sample.time_ns, depth > 0}, sample).force_N;
    for (int k = 0; k < 20; ++k) {
      v += kPeriod_s / 20 * (force_N.y() - 0.5) / loop.mass_kg;
      y += kPeriod_s / 20 * v;
    }
    if (i <= 100) swing.first_m_s = std::max(swing.first_m_s, std::abs(v));
    if (i > 9000) swing.last_m_s = std::max(swing.last_m_s, std::abs(v));
  }
  swing.dissipated_J = state.guard.dissipated_J;
  return swing;
}

TEST(PassivityGuard, ALoopThatFeedsEnergyIsMadeBounded) {
  for (const double stiffness_N_m : {500.0, 1000.0, 2000.0, 3000.0}) {
    for (const int delay_steps : {0, 1, 2, 4}) {
      Loop loop{0.1, stiffness_N_m, delay_steps, false};
      const Swing wild = press(loop);
      EXPECT_GT(wild.last_m_s, 4 * wild.first_m_s) << stiffness_N_m << " " << delay_steps;
      loop.guard = true;
      const Swing tame = press(loop);
      EXPECT_LT(tame.last_m_s, tame.first_m_s * 1.1) << stiffness_N_m << " " << delay_steps;
      EXPECT_GT(tame.dissipated_J, 0);
    }
  }
}

// What only takes energy never runs into debt.
TEST(PassivityGuard, APassiveHandIsNotTouched) {
  PassivitySettings settings;
  PassivityGuard guard;
  double taken_J = 0;
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) {  // a dry friction: always against the way
    const Vec3 next = 0.01 * Vec3(std::sin(0.01 * i), std::cos(0.013 * i), 0);
    const Vec3 way = next - at;
    at = next;
    const Vec3 force_N = dampedToPassive(guard, settings, -way.normalized(), way, true, kPeriod_s);
    EXPECT_EQ(force_N, Vec3(-way.normalized()));
    if (i > 0) taken_J = guard.energy_J;
    guard.held_N = -(0.01 * Vec3(std::sin(0.01 * (i + 1)), std::cos(0.013 * (i + 1)), 0) - at).normalized();
  }
  EXPECT_GT(taken_J, 0.05);
  EXPECT_EQ(guard.dissipated_J, 0);
}

TEST(PassivityGuard, ADebtIsKeptInTheOpenAndASurplusIsForgotten) {
  PassivitySettings settings;
  PassivityGuard guard;
  guard.energy_J = 0.01;
  dampedToPassive(guard, settings, Vec3::Zero(), Vec3(1e-3, 0, 0), false, kPeriod_s);
  EXPECT_EQ(guard.energy_J, 0);
  guard.energy_J = -0.01;
  dampedToPassive(guard, settings, Vec3::Zero(), Vec3(1e-3, 0, 0), false, kPeriod_s);
  EXPECT_EQ(guard.energy_J, -0.01);
  // A damper that would take it back in one step would need 10 Ns/m at 1 m/s.
  const Vec3 force_N = dampedToPassive(guard, settings, Vec3::Zero(), Vec3(1e-3, 0, 0), true, kPeriod_s);
  EXPECT_NEAR(force_N.x(), -10, 1e-9);
}

}  // namespace
}  // namespace hl::test_passivity_guard
