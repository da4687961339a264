// One tick's entry in the energy ledger: what may be added, what is charged to whom, and the target that comes of it.
#include "proxy/energy_booking.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/scenes.h"

namespace hl::test_energy_booking {
namespace {

constexpr double kK = 1000;
constexpr double kDepth = 0.002;

ProxySettings settingsOf(LedgerMode mode) {
  ProxySettings settings;
  settings.spring_N_m = kK;
  settings.ledger = mode;
  return settings;
}

// At the origin, held by a surface of this stiffness.
ProxyState heldBy(double stiffness, double tank_J = kTankStart_J) {
  ProxyState state;
  state.touching = true;
  state.stiffness = stiffness;
  state.ledger.tank_J = tank_J;
  return state;
}

MeanStiffness surfaceOf(double stiffness) {
  MeanStiffness mean;
  mean.add(0.001, stiffness);
  return mean;
}

double booked_J(const ProxyState& state, EnergyCause cause) {
  return state.ledger.by_cause_J[static_cast<std::size_t>(cause)];
}

const Vec3 kFinger(0, -kDepth, 0);

TEST(EnergyBooking, AStepTowardTheFingerIsFree) {
  const ProxySettings settings = settingsOf(LedgerMode::kStrict);
  EnergyBooking booking(heldBy(1), settings, kFinger);
  const Vec3 step(0, -0.7 * kDepth, 0);
  EXPECT_EQ(booking.afford(Vec3::Zero(), step), step);
  EXPECT_FALSE(booking.spent());
}

// To its mirror image beyond the finger: the fall on the way there pays for nothing of the rise.
TEST(EnergyBooking, WhatRisesBeyondTheFingerIsPaidInFull) {
  const Vec3 step(0, -2 * kDepth, 0);
  for (const double stiffness : {1.0, 0.25}) {
    for (const double tank_J : {0.0, 1e-4, 3e-4, 1.0}) {
      const ProxySettings settings = settingsOf(LedgerMode::kTank);
      EnergyBooking booking(heldBy(stiffness, tank_J), settings, kFinger);
      const double beyond = std::min(kDepth, std::sqrt(2 * tank_J / (kK * stiffness)));
      EXPECT_NEAR(booking.afford(Vec3::Zero(), step).y(), -kDepth - beyond, 1e-15) << stiffness << ", " << tank_J;
      EXPECT_EQ(booking.spent(), beyond < kDepth);
    }
  }
}

TEST(EnergyBooking, WhereNothingIsRefusedOrNothingPullsAllIsAffordable) {
  const Vec3 step(0, 5, 0);
  const ProxySettings report = settingsOf(LedgerMode::kReport);
  EXPECT_EQ(EnergyBooking(heldBy(1), report, kFinger).afford(Vec3::Zero(), step), step);
  ProxySettings no_spring = settingsOf(LedgerMode::kStrict);
  no_spring.spring_N_m = 0;
  EXPECT_EQ(EnergyBooking(heldBy(1), no_spring, kFinger).afford(Vec3::Zero(), step), step);
}

TEST(EnergyBooking, AChangeOfStiffnessIsBookedAndPaidByTheTank) {
  const double whole_J = 0.5 * kK * 0.7 * kDepth * kDepth;  // from 0.2 to 0.9
  for (const bool textured : {false, true}) {
    for (const double tank_J : {1.0, 0.25 * whole_J, 0.0}) {
      const ProxySettings settings = settingsOf(LedgerMode::kTank);
      ProxyState state = heldBy(0.2, tank_J);
      TickReport report;
      EnergyBooking(state, settings, kFinger).close(state, TickEnd::kContact, surfaceOf(0.9), {0, 0, textured}, report);
      const double paid_J = std::min(tank_J, whole_J);
      EXPECT_NEAR(report.injected_J, paid_J, 1e-15);
      EXPECT_NEAR(booked_J(state, textured ? EnergyCause::kTexture : EnergyCause::kStiffness), paid_J, 1e-15);
      EXPECT_NEAR(state.ledger.tank_J, tank_J - paid_J, 1e-15);
      EXPECT_NEAR(state.stiffness, 0.2 + 0.7 * paid_J / whole_J, 1e-12);
      EXPECT_NEAR(report.target.y(), -kDepth * (1 - state.stiffness), 1e-15);
    }
  }
}

TEST(EnergyBooking, SofterIsDissipationAndRefillsTheTank) {
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  ProxyState state = heldBy(0.9, 0);
  TickReport report;
  EnergyBooking(state, settings, kFinger).close(state, TickEnd::kContact, surfaceOf(0.2), {}, report);
  const double freed_J = 0.5 * kK * 0.7 * kDepth * kDepth;
  EXPECT_NEAR(report.injected_J, -freed_J, 1e-15);
  EXPECT_NEAR(state.ledger.tank_J, freed_J, 1e-15);
  EXPECT_EQ(state.stiffness, 0.2);
}

TEST(EnergyBooking, TheFallOfATickThatLandsRefillsNothing) {
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  ProxyState state;
  state.ledger.tank_J = 0.001;
  EnergyBooking booking(state, settings, kFinger);
  state.position = 0.5 * kFinger;
  TickReport report;
  booking.close(state, TickEnd::kContact, surfaceOf(1), {}, report);
  EXPECT_NEAR(report.injected_J, -0.75 * 0.5 * kK * kDepth * kDepth, 1e-15);
  EXPECT_EQ(state.ledger.tank_J, 0.001);
}

TEST(EnergyBooking, ComingIntoContactChargesNothing) {
  const ProxySettings settings = settingsOf(LedgerMode::kStrict);
  ProxyState state;
  TickReport report;
  EnergyBooking(state, settings, kFinger).close(state, TickEnd::kContact, surfaceOf(0.5), {}, report);
  EXPECT_EQ(report.injected_J, 0);
  EXPECT_EQ(state.stiffness, 0.5);
  EXPECT_TRUE(state.touching);
}

TEST(EnergyBooking, InTheOpenTheTargetIsTheProxyAndNothingIsStuck) {
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  ProxyState state = heldBy(0.3);
  state.sticking.since_slip_s = 0;
  state.sticking.springs.stretch_m = Vec3(1e-6, 0, 0);
  EnergyBooking booking(state, settings, kFinger);
  state.position = kFinger;
  TickReport report;
  booking.close(state, TickEnd::kOpen, {}, {}, report);
  EXPECT_EQ(report.target, kFinger);
  EXPECT_FALSE(state.touching);
  EXPECT_EQ(state.stiffness, 1);
  EXPECT_EQ(state.sticking.since_slip_s, accuracy::kStuck_s);
  EXPECT_EQ(state.sticking.springs.stretch_m, Vec3(Vec3::Zero()));
}

TEST(EnergyBooking, OnItsWayItAddsNothingAndFromTheOpenItPullsNowhere) {
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  TickReport report;
  ProxyState from_open;
  EnergyBooking(from_open, settings, kFinger).close(from_open, TickEnd::kOnItsWay, {}, {}, report);
  EXPECT_EQ(report.target, kFinger);
  EXPECT_FALSE(from_open.touching);
  ProxyState held = heldBy(0.3);
  EnergyBooking(held, settings, kFinger).close(held, TickEnd::kOnItsWay, surfaceOf(0.8), {}, report);
  EXPECT_EQ(held.stiffness, 0.3) << "no harder, whatever the tank holds";
  EXPECT_EQ(report.injected_J, 0);
}

TEST(EnergyBooking, ARiseIsChargedToWhatBentTheWay) {
  const ProxySettings settings = settingsOf(LedgerMode::kReport);
  const double rise_J = 0.5 * kK * (1.21 - 1) * kDepth * kDepth;
  const auto closed = [&](const EnergyBooking::Causes& causes) {
    ProxyState state = heldBy(1);
    EnergyBooking booking(state, settings, kFinger);
    state.position = Vec3(0, 0.1 * kDepth, 0);
    TickReport report;
    booking.close(state, TickEnd::kContact, surfaceOf(1), causes, report);
    EXPECT_NEAR(report.injected_J, rise_J, 1e-15);
    return state;
  };
  const ProxyState bent = closed({0.03, 0.01, false});
  EXPECT_NEAR(booked_J(bent, EnergyCause::kShading), 0.75 * rise_J, 1e-15);
  EXPECT_NEAR(booked_J(bent, EnergyCause::kTexture), 0.25 * rise_J, 1e-15);
  EXPECT_NEAR(booked_J(closed({}), EnergyCause::kStiffness), rise_J, 1e-15) << "springs that creep back";
}

TEST(EnergyBooking, TheMeanStiffnessIsWeightedAndWithinThoseOfTheSurfaces) {
  MeanStiffness mean;
  EXPECT_TRUE(mean.empty());
  EXPECT_EQ(mean.value(), 1);
  mean.add(0, 0.7);
  mean.add(-1e-9, 0.4);
  EXPECT_EQ(mean.value(), 0.4) << "nothing presses: the softest";
  mean.add(0.003, 0.2);
  mean.add(0.001, 0.6);
  EXPECT_NEAR(mean.value(), 0.3, 1e-15);
}

// A tick of random steps, each afforded, from a random state.
struct RandomTick {
  explicit RandomTick(std::uint64_t seed) : random(seed) {
    settings = settingsOf(random.below(2) == 0 ? LedgerMode::kTank : LedgerMode::kStrict);
    settings.world_per_device = random.uniform(0.1, 10);
    state.position = random.inCube(0.01);
    state.touching = random.below(3) > 0;
    state.stiffness = state.touching ? random.uniform(0.05, 1) : 1;
    state.ledger.tank_J = random.uniform(0, 0.02);
    finger = random.inCube(0.01);
    before = state;
  }
  double energy_J(double stiffness, const Vec3& proxy) const {
    return 0.5 * kK * stiffness * ((proxy - finger) / settings.world_per_device).squaredNorm();
  }
  double budget_J() const { return before.ledger.budget_J(settings.ledger); }
  // Of all energies in this tick.
  double rounding_J() const { return 1e-12 * energy_J(1, finger + Vec3::Constant(0.1)); }

  test::Random random;
  ProxySettings settings;
  ProxyState state, before;
  Vec3 finger;
};

RC_GTEST_PROP(EnergyBooking, WhatIsAffordedNeverRaisesTheEnergyBeyondTheBudget, (std::uint64_t seed)) {
  RandomTick tick(seed);
  EnergyBooking booking(tick.state, tick.settings, tick.finger);
  const double start_J = tick.energy_J(tick.state.stiffness, tick.state.position);
  Vec3 proxy = tick.state.position;
  for (int i = 0; i < 20; ++i) {
    const Vec3 step = tick.random.inCube(0.02), part = booking.afford(proxy, step);
    RC_ASSERT(part.cross(step).norm() <= 1e-12 * step.squaredNorm());
    RC_ASSERT(part.dot(step) >= 0);
    RC_ASSERT(part.norm() <= step.norm());
    RC_ASSERT(booking.spent() == (part != step));
    // The energy is a parabola along the step: what comes after its least is a rise.
    const double nearest = std::clamp(step.dot(tick.finger - proxy) / step.squaredNorm(), 0.0, 1.0);
    const double least_J = tick.energy_J(tick.before.stiffness, proxy + nearest * step);
    proxy += part;
    const double now_J = tick.energy_J(tick.before.stiffness, proxy);
    RC_ASSERT(now_J <= start_J + tick.budget_J() + tick.rounding_J());
    RC_ASSERT(now_J <= least_J + tick.budget_J() + tick.rounding_J());
    RC_ASSERT(part.norm() >= nearest * step.norm() * (1 - 1e-12));
  }
}

RC_GTEST_PROP(EnergyBooking, ATickBooksWhatItDidToTheEnergyAndNoMoreThanItMay, (std::uint64_t seed)) {
  RandomTick tick(seed);
  ProxyState& state = tick.state;
  EnergyBooking booking(state, tick.settings, tick.finger);
  for (int i = 0; i < 3; ++i) state.position += booking.afford(state.position, tick.random.inCube(0.01));
  const auto end = static_cast<TickEnd>(tick.random.below(3));
  if (end == TickEnd::kOpen) state.position = tick.finger;
  MeanStiffness surfaces;
  for (int i = end == TickEnd::kOpen ? 0 : tick.random.below(3); i > 0; --i)
    surfaces.add(tick.random.uniform(0, 0.01), tick.random.uniform(0, 1));
  const EnergyBooking::Causes causes{tick.random.uniform(0, 0.1), tick.random.uniform(0, 0.1), false};
  TickReport report;
  booking.close(state, end, surfaces, causes, report);

  const Vec3 pull = report.target - tick.finger, whole = state.position - tick.finger;
  RC_ASSERT(pull.dot(whole) >= 0);
  RC_ASSERT(pull.norm() <= whole.norm() * (1 + 1e-12));
  RC_ASSERT(report.injected_J <= (end == TickEnd::kOnItsWay ? 0 : tick.budget_J()) + tick.rounding_J());
  if (tick.before.touching && state.touching) {
    const double did_J =
        tick.energy_J(state.stiffness, state.position) - tick.energy_J(tick.before.stiffness, tick.before.position);
    RC_ASSERT(std::abs(report.injected_J - did_J) <= tick.rounding_J());
  }
  const auto& causes_J = state.ledger.by_cause_J;
  const double booked_J = std::accumulate(causes_J.begin(), causes_J.end(), 0.0);
  RC_ASSERT(booked_J >= report.injected_J - tick.rounding_J());
  RC_ASSERT(state.ledger.tank_J >= 0);
  RC_ASSERT(state.ledger.tank_J <= std::max(kTankFull_J, tick.before.ledger.tank_J));
  RC_ASSERT(state.ledger.injected_J - state.ledger.dissipated_J == report.injected_J);
}

}  // namespace
}  // namespace hl::test_energy_booking
