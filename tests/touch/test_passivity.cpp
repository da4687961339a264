// The theorem behind the ledger (science, fault 3), with everything real: proxy, servo and the simulated PHANToM in a
// hand. A spring held for a step does the work -(S+ - S) + 1/2 K |step|^2, S = 1/2 K s |proxy - finger|^2; so if no
// tick raises S at the finger it sees, all that the spring ever gives is what the held steps leak, which damping of
// K T / 2 takes up. A late proxy breaks it unless it is handed over monotonely (fault 4): proxy and servo are real
// there too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include "control/servo.h"
#include "device/simulated_device.h"
#include "proxy/effect_scenes.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl::test_passivity {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

// A soup of shaded triangles of uneven stiffness and friction, 60 mm about the device's origin.
std::shared_ptr<const Snapshot> soup(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3(u(random), u(random), u(random)); };
  Model model;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 a = 0.03 * vec(), b = a + 0.03 * vec(), c = a + 0.03 * vec();
    const Vec3 face = (b - a).cross(c - a).normalized();
    for (const Vec3& p : {a, b, c}) {
      model.positions.push_back(p);
      model.normals.push_back((face + 0.6 * vec()).normalized());
      model.texcoords.emplace_back(2 * u(random), 2 * u(random));
    }
    model.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  model.textures = {makeTexture("noise", 16)};
  model.materials[0].smooth = true;
  model.materials[0].dynamic_friction = 0.3;
  model.materials[0].textureOf(Quantity::kStiffness) = {0, 0.3, 1};
  return makeSnapshot(std::move(model), HierarchyKind::kBvh);
}

struct Work {
  double excess_J = 0;  // largest work given beyond the leak of the held steps
  double given_J = 0;   // largest work given in all
  int touching = 0;     // steps in contact
};

Work strokeSoup(unsigned seed, LedgerMode mode, bool firm) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto scene = soup(random);
  SimulatedDeviceSettings coarse;
  coarse.step_s = 50e-6;
  coarse.firm = firm;
  SimulatedDevice device(coarse);
  ServoSettings servo_settings = ServoSettings::of(device.info());
  servo_settings.damping_Ns_m = 0;
  servo_settings.ramp_s = 1e-3;
  servo_settings.ledger = mode;
  servo_settings.friction_N = 0;
  ProxySettings proxy_settings;
  proxy_settings.spring_N_m = servo_settings.stiffness_N_m;
  proxy_settings.ledger = mode;
  ServoState servo;
  ProxyState proxy;
  Work work;
  double given_J = 0, leak_J = 0;
  Vec3 last = Vec3::Zero(), force = Vec3::Zero();
  for (std::int64_t i = 0; i < 3000; ++i) {
    if (i == 5) arm(servo);
    if (i % 400 == 0) device.setHandGoal(0.05 * Vec3(u(random), u(random), u(random)));
    const DeviceSample sample = device.read(i * kPeriod_ns);
    if (i > 0) {
      given_J += force.dot(sample.position - last);
      leak_J += 0.5 * servo_settings.stiffness_N_m * (sample.position - last).squaredNorm();
    }
    work.given_J = std::max(work.given_J, given_J);
    work.excess_J = std::max(work.excess_J, given_J - leak_J);
    last = sample.position;
    const TickReport report = tick(proxy, *scene, proxy_settings, sample.position);
    const bool touching = proxy.free && !report.contacts.empty();
    work.touching += touching ? 1 : 0;
    force = stepServo(servo, servo_settings,
                      {proxy.position, sample.time_ns, touching, proxy.stiffness, report.injected_J}, sample)
                .force_N;
    device.write(force);
  }
  return work;
}

TEST(Passivity, FortyStrokesOverASoupGiveNoMoreThanTheLedgerAllows) {
  int touching = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const bool firm = seed % 2 == 0;
    const Work strict = strokeSoup(seed, LedgerMode::kStrict, firm);
    EXPECT_LE(strict.excess_J, 1e-9) << seed;
    EXPECT_LE(strokeSoup(seed, LedgerMode::kTank, firm).excess_J, kTankFull_J) << seed;
    touching += strict.touching;
  }
  EXPECT_GT(touching, 10'000);
}

// A device of one mass in a light hand, without the joint friction of the simulated PHANToM: friction takes energy up,
// so that a loop that feeds some can swing a little forever instead of more and more, and proves nothing either way.
// The hand's damping is just what held steps of 1 ms leak, K T / 2 = 0.9 Ns/m; lateness of 66 ms would need 0.2172 K
// tau = 26 Ns/m, and without damping 16 ms are too late, pi sqrt(m / 2K) at 95 g.
struct HeldMass {
  static constexpr double kHand_kg = 0.020, kHand_N_m = 100, kHand_Ns_m = 1;
  static constexpr int kSubsteps = 20;
  double mass_kg;
  Vec3 goal, position, velocity;

  void step(const Vec3& force_N) {
    const double dt_s = 1e-9 * kPeriod_ns / kSubsteps;
    for (int i = 0; i < kSubsteps; ++i) {
      const Vec3 all_N = force_N + kHand_N_m * (goal - position) - kHand_Ns_m * velocity;
      velocity += dt_s / (mass_kg + kHand_kg) * all_N;
      position += dt_s * velocity;
    }
  }
};

HeldMass pressingOnTheFloor(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  HeldMass plant;
  plant.mass_kg = 0.075 + 0.010 * u(random);
  plant.goal = Vec3(0, -0.015 + 0.005 * u(random), 0);
  plant.position = Vec3(0.005 * u(random), 0.003, 0.005 * u(random));
  plant.velocity = Vec3(0.1 * u(random), 0, 0.1 * u(random));
  return plant;
}

struct Swing {
  double at_first_m_s = 0;  // fastest in the first 50 ms, before the first late proxy pulls
  double at_last_m_s = 0;   // fastest in the last second
  double force_N = 0;       // largest
  FaultReason fault = FaultReason::kNone;
};

// A floor y = 0 whose proxy is computed once in `late` ms and arrives `late` ms after its finger was read.
class LateFloor {
 public:
  LateFloor(LedgerMode mode, int late, double spring_N_m, const Vec3& finger)
      : scene_(test::snapshotOf(test::floorModel())), late_ns_(late * kPeriod_ns) {
    settings_.spring_N_m = spring_N_m;
    settings_.ledger = mode;
    proxy_ = startProxy(*scene_, settings_, finger);
  }

  const ServoTarget& target(std::int64_t now_ns, const Vec3& finger) {
    if (now_ns % late_ns_ == 0) {
      const TickReport report = tick(proxy_, *scene_, settings_, finger);
      on_the_way_.push_back({proxy_.position, now_ns, !report.contacts.empty(), proxy_.stiffness, report.injected_J});
    }
    while (!on_the_way_.empty() && on_the_way_.front().time_ns + late_ns_ <= now_ns) {
      arrived_ = on_the_way_.front();
      on_the_way_.pop_front();
    }
    return arrived_;
  }

 private:
  std::shared_ptr<const Snapshot> scene_;
  std::int64_t late_ns_;
  ProxySettings settings_;
  ProxyState proxy_;
  std::deque<ServoTarget> on_the_way_;
  ServoTarget arrived_;
};

// Pressed on the floor for four seconds.
Swing pressOnFloor(LedgerMode mode, int late, unsigned seed) {
  ServoSettings settings = ServoSettings::of(SimulatedDevice().info());
  settings.stiffness_N_m = 1800;
  settings.damping_Ns_m = 0;
  settings.ramp_s = 1e-3;
  settings.friction_N = 0;
  settings.target_stale_ns = 4 * late * kPeriod_ns;
  settings.ledger = mode;
  settings.vibration.on = false;  // it would soften what diverges
  HeldMass plant = pressingOnTheFloor(seed);
  LateFloor floor(mode, late, settings.stiffness_N_m, plant.position);
  ServoState servo;
  arm(servo);
  Swing swing;
  for (int i = 0; i < 4000; ++i) {
    DeviceSample sample;
    sample.status = DeviceStatus::kOk;
    sample.position = plant.position;
    sample.time_ns = i * kPeriod_ns;
    const ServoOutput output = stepServo(servo, settings, floor.target(sample.time_ns, sample.position), sample);
    plant.step(output.force_N);
    swing.force_N = std::max(swing.force_N, output.force_N.norm());
    if (output.safety == SafetyState::kFault) swing.fault = output.fault;
    if (i < 50) swing.at_first_m_s = std::max(swing.at_first_m_s, plant.velocity.norm());
    if (i >= 3000) swing.at_last_m_s = std::max(swing.at_last_m_s, plant.velocity.norm());
  }
  return swing;
}

// Fault 4. Naive hand-over swings up until the motors give no more, or the servo's limit of speed cuts the force. It is
// the lateness that does it: on time, the same settles. Handed over monotonely, the late ones settle too.
TEST(Passivity, LateProxiesHandedOverAtOnceDivergeInEveryRunAndMonotoneOnesSettle) {
  constexpr double kWild_m_s = 2, kSettled_m_s = 0.1;
  const double most_N = SimulatedDevice().info().force_max_N;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Swing naive = pressOnFloor(LedgerMode::kReport, 33, seed);
    EXPECT_LT(naive.at_first_m_s, kWild_m_s / 2) << seed;
    EXPECT_TRUE(naive.fault == FaultReason::kTooFast || naive.at_last_m_s > kWild_m_s) << seed;
    EXPECT_NEAR(naive.force_N, most_N, 1e-9) << seed;
    for (const LedgerMode mode : {LedgerMode::kStrict, LedgerMode::kTank}) {
      const Swing monotone = pressOnFloor(mode, 33, seed);
      EXPECT_EQ(monotone.fault, FaultReason::kNone) << seed;
      EXPECT_LT(monotone.at_last_m_s, kSettled_m_s) << seed;
    }
    EXPECT_LT(pressOnFloor(LedgerMode::kReport, 1, seed).at_last_m_s, kSettled_m_s) << seed;
  }
}

}  // namespace
}  // namespace hl::test_passivity
