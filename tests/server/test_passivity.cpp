// The theorem behind the ledger (science, fault 3), with everything real: proxy, servo and the simulated PHANToM in a
// hand. A spring held for a step does the work -(S+ - S) + 1/2 K |step|^2, S = 1/2 K s |proxy - finger|^2; so if no
// tick raises S at the finger it sees, all that the spring ever gives is what the held steps leak, which damping of
// K T / 2 takes up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "control/servo.h"
#include "device/simulated_device.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl {
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
  return makeSnapshot(std::move(model), HierarchyKind::kSpheres);
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

}  // namespace
}  // namespace hl
