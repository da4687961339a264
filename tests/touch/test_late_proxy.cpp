// A proxy loop as slow as one likes: its ticks begin once a period and arrive a period later, and the servo makes do
// with the contacts of the last that has come. The force stays bounded, nothing swings up, and the spring gives no more
// energy than the ledgers allow (the paper: sticky, not unstable; science, faults 3 and 4).
#include <gtest/gtest.h>

#include <deque>

#include "device/person_script.h"
#include "device/simulated_device.h"
#include "proxy/effect_scenes.h"
#include "touch/touch_step.h"

namespace hl::test_late_proxy {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kStiffness_N_m = 1800;

enum class Surface : std::uint8_t { kSmooth, kRough };

std::shared_ptr<const Snapshot> floorOf(Surface surface) {
  Model model = test::floorModel();
  if (surface == Surface::kRough) model.materials[0].static_friction = model.materials[0].dynamic_friction = 0.4;
  return test::snapshotOf(std::move(model));
}

// Presses, taps, strokes, lets go while pressing and in the open, takes the device again, and waits for the proxy.
test::PersonScript person(double late_s) {
  test::PersonScript script({0, 0.012, 0}, 0.3);
  script.press({0, -0.03, 0}, 0.2, 0.6)
      .tap({0, -0.02, 0}, 0.25, 3)
      .stroke({0, -0.025, 0}, {0.04, 0, -0.02}, 0.15)
      .moveTo({0.01, -0.02, 0}, 0.2)
      .letGo(0.4)
      .moveTo({0, 0.02, 0}, 0.2)
      .letGo(0.2)
      .wait(1 + 3 * late_s);
  return script;
}

// The servo's side of a proxy loop of that period and latency.
class LateLoop {
 public:
  LateLoop(std::shared_ptr<const Snapshot> scene, std::int64_t late_ns)
      : scenes_(std::move(scene)), loop_(scenes_, {}), late_ns_(late_ns) {
    commands_.radius_W = 0.002;
  }

  const HeldContacts& at(const DeviceSample& sample, LedgerMode mode) {
    if (sample.time_ns % late_ns_ == 0) {
      const SpringOfServo spring{kStiffness_N_m, mode, 1e-9 * static_cast<double>(late_ns_)};
      on_the_way_.push_back(loop_.step(sample.time_ns, sample.position, commands_, spring).held);
    }
    while (!on_the_way_.empty() && on_the_way_.front().target.time_ns + late_ns_ <= sample.time_ns) {
      arrived_ = on_the_way_.front();
      on_the_way_.pop_front();
    }
    return arrived_;
  }
  const Ledger& ledger() const { return loop_.state().ledger; }

 private:
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  ProxyCommands commands_;
  std::int64_t late_ns_;
  std::deque<HeldContacts> on_the_way_;
  HeldContacts arrived_;
};

struct Felt {
  double force_N = 0;    // largest
  double excess_J = 0;   // largest work given beyond what held steps leak
  double allowed_J = 0;  // by both ledgers
  double rest_m_s = 0;   // fastest in the last 0.3 s
  FaultReason fault = FaultReason::kNone;
  int touching = 0;
};

ServoSettings settingsFor(const DeviceInfo& info, std::int64_t late_ns, LedgerMode mode) {
  ServoSettings settings = ServoSettings::of(info);
  settings.stiffness_N_m = kStiffness_N_m;
  settings.damping_Ns_m = 0;
  settings.ramp_s = 1e-3;
  settings.friction_N = 0;
  settings.ledger = mode;
  settings.target_stale_ns = 4 * late_ns;  // it is to be felt, however old
  settings.target_lost_ns = 10 * late_ns;
  return settings;
}

Felt feel(std::int64_t late_ns, Surface surface, bool firm, LedgerMode mode) {
  SimulatedDeviceSettings device_settings;
  device_settings.model = premium10();
  device_settings.firm = firm;
  SimulatedDevice device(device_settings);
  const ServoSettings settings = settingsFor(device.info(), late_ns, mode);
  LateLoop late(floorOf(surface), late_ns);
  TouchStep step;
  const test::PersonScript script = person(1e-9 * static_cast<double>(late_ns));
  Felt felt;
  double given_J = 0, leak_J = 0;
  Vec3 last = Vec3::Zero(), force = Vec3::Zero();
  const std::int64_t end_ns = static_cast<std::int64_t>(1e9 * script.duration_s()) / kMs * kMs;
  device.place(script.at(0), Vec3::Zero());
  for (std::int64_t t = 0; t < end_ns; t += kMs) {
    if (t == 5 * kMs) arm(step.servo());
    const double time_s = 1e-9 * static_cast<double>(t);
    device.setHandGoal(script.at(time_s));
    device.setHandHolds(script.holdsAt(time_s));
    const DeviceSample sample = device.read(t);
    if (t > 0) {
      given_J += force.dot(sample.position - last);
      leak_J += 0.5 * kStiffness_N_m * (sample.position - last).squaredNorm();
    }
    felt.excess_J = std::max(felt.excess_J, given_J - leak_J);
    last = sample.position;
    const ServoOutput out = step.late(late.at(sample, mode), settings, sample);
    force = out.force_N;
    device.write(force);
    felt.force_N = std::max(felt.force_N, force.norm());
    felt.touching += force.norm() > 0.1 ? 1 : 0;
    if (out.safety == SafetyState::kFault) felt.fault = out.fault;
    if (t > end_ns - 300 * kMs) felt.rest_m_s = std::max(felt.rest_m_s, device.trueVelocity_D().norm());
  }
  felt.allowed_J = late.ledger().injected_J + step.servo().spring.ledger.injected_J;
  return felt;
}

class LateProxy : public testing::TestWithParam<std::tuple<int, Surface, bool>> {};

TEST_P(LateProxy, IsStickyButNotUnstable) {
  const auto [late_ms, surface, firm] = GetParam();
  const double most_N = premium10().info.force_max_N;
  for (const LedgerMode mode : {LedgerMode::kStrict, LedgerMode::kTank}) {
    const Felt felt = feel(late_ms * kMs, surface, firm, mode);
    EXPECT_LE(felt.force_N, most_N * (1 + 1e-12));
    EXPECT_LE(felt.excess_J, felt.allowed_J + 1e-9);
    if (mode == LedgerMode::kStrict) {
      EXPECT_LE(felt.excess_J, 1e-9);
    }
    EXPECT_LT(felt.rest_m_s, 0.01);
    // A hand that lets go of a spring stretched to a proxy of a second ago: the device flies off, and is cut.
    const bool cut = late_ms == 1000 && felt.fault == FaultReason::kTooFast;
    EXPECT_TRUE(felt.fault == FaultReason::kNone || cut) << faultText(felt.fault);
    EXPECT_GT(felt.touching, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Periods, LateProxy,
                         testing::Combine(testing::Values(1, 10, 33, 100, 1000),
                                          testing::Values(Surface::kSmooth, Surface::kRough), testing::Bool()));

// A mass without any damping that slides on a smooth floor, its proxy late by `late` steps of 0.1 ms: how much faster
// it is after three seconds than it began.
double growthOfSliding(int late, bool planes_kept) {
  constexpr std::int64_t kStep_ns = 100'000;
  constexpr double kLoad_N = 1, kSpeed_m_s = 0.02;
  SimulatedDeviceSettings device_settings;
  device_settings.model = linearDevice(0.075, 0);
  device_settings.held = false;
  device_settings.load_N = {0, -kLoad_N, 0};
  device_settings.step_s = 2e-6;
  SimulatedDevice device(device_settings);
  ServoSettings settings = settingsFor(device.info(), 100 * kMs, LedgerMode::kReport);
  settings.period_s = settings.ramp_s = 1e-9 * kStep_ns;
  SnapshotSlot scenes(floorOf(Surface::kSmooth));
  ProxyLoop loop(scenes, {});
  ProxyCommands commands;
  commands.radius_W = 0.002;
  const SpringOfServo spring{kStiffness_N_m, LedgerMode::kReport, settings.period_s};
  for (int i = 0; i < 1000; ++i) loop.step(i * kStep_ns, {0, 0.01, 0}, commands, spring);  // the scene has faded in
  device.read(1000 * kStep_ns);
  device.place({0, 0.002 - kLoad_N / kStiffness_N_m, 0}, {kSpeed_m_s, 0, 0});
  TouchStep step;
  arm(step.servo());
  std::deque<HeldContacts> on_the_way;
  double fastest_m_s = 0;
  for (std::int64_t i = 1000; i < 31'000; ++i) {
    const DeviceSample sample = device.read(i * kStep_ns);
    on_the_way.push_back(loop.step(sample.time_ns, sample.position, commands, spring).held);
    if (!planes_kept) on_the_way.back().planes_D.clear();
    while (on_the_way.size() > static_cast<std::size_t>(late) + 1) on_the_way.pop_front();
    device.write(step.late(on_the_way.front(), settings, sample).force_N);
    if (i > 30'000) fastest_m_s = std::max(fastest_m_s, std::abs(device.trueVelocity_D().x()));
  }
  return fastest_m_s / kSpeed_m_s;
}

// Science, fault 4: pi sqrt(m / 2 K) = 14.3 ms for 75 g and 1.8 kN/m. What a proxy that stands still until the next
// tick does to a sliding finger, the planes of the same tick do not.
TEST(HeldProxy, ASlidingFingerSwingsUpFromTheLatenessThatTheoryTellsAndOnPlanesNever) {
  const double critical_s = M_PI * std::sqrt(0.075 / (2 * kStiffness_N_m));
  const auto below = static_cast<int>(0.97 * critical_s / 1e-4), above = static_cast<int>(1.03 * critical_s / 1e-4);
  EXPECT_LT(growthOfSliding(below, false), 1);
  EXPECT_GT(growthOfSliding(above, false), 1);
  EXPECT_NEAR(growthOfSliding(above, true), 1, 1e-3);
}

}  // namespace
}  // namespace hl::test_late_proxy
