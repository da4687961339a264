// Stiffness by moving the target (the paper's equation 4), and the energy ledger.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_stiffness {
namespace {

constexpr double kK = 1000;
constexpr double kRadius = 0.001;

ProxySettings settingsOf(LedgerMode mode) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.ledger = mode;
  return settings;
}

// Two halves of a floor, stiffness `left` for x < 0 and `right` beyond.
std::shared_ptr<const Snapshot> twoFloors(double left, double right) {
  Model model;
  test::addRectangle(model, {-0.1, 0, 0.1}, {0.1, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
  test::addRectangle(model, {0, 0, 0.1}, {0.1, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
  model.materials.resize(2);
  model.materials[0].stiffness = left;
  model.materials[1].stiffness = right;
  model.triangle_materials = {0, 0, 1, 1};
  return test::snapshotOf(std::move(model));
}

// C34: F(s) = s F(1) to the bit of rounding, in a corner of three planes too, and the proxy goes the same way.
TEST(Stiffness, ForceScalesAndTheProxyIsUntouched) {
  Model model = test::floorModel();
  test::addRectangle(model, {0.02, 0, 0.1}, {0, 0, -0.2}, {0, 0.1, 0}, -Vec3::UnitX());
  test::addRectangle(model, {-0.1, 0, 0.03}, {0.2, 0, 0}, {0, 0.1, 0}, -Vec3::UnitZ());
  const auto scene = test::snapshotOf(std::move(model));
  std::mt19937 random(2);
  std::normal_distribution<double> jump(0, 1e-3);
  ProxySettings hard = settingsOf(LedgerMode::kReport), soft = hard;
  soft.surfaces.stiffness = 0.3;
  ProxyState a = startProxy(*scene, hard, {0, 0.01, 0}), b = a;
  Vec3 finger(0, 0.01, 0);
  for (int i = 0; i < 20'000; ++i) {
    finger = (finger + Vec3(jump(random), jump(random), jump(random))).cwiseMin(0.04).cwiseMax(-0.04);
    const TickReport full = tick(a, *scene, hard, finger);
    const TickReport part = tick(b, *scene, soft, finger);
    ASSERT_EQ(a.position, b.position);
    ASSERT_LE(((part.target - finger) - 0.3 * (full.target - finger)).norm(), 1e-15);
  }
}

// A soft floor beside a hard wall: the mean of the two, weighted by their normal forces.
TEST(Stiffness, SeveralSurfacesShareByTheirNormalForces) {
  Model model = test::floorModel();
  test::addRectangle(model, {0.02, 0, 0.1}, {0, 0, -0.2}, {0, 0.1, 0}, -Vec3::UnitX());
  model.materials.resize(2);
  model.materials[0].stiffness = 0.25;
  model.triangle_materials = {0, 0, 1, 1};
  const auto scene = test::snapshotOf(std::move(model));
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  const Vec3 finger(0.022, -0.001, 0);  // 2 mm into the floor, 3 mm into the wall
  tick(state, *scene, settings, {0.018, -0.001, 0});
  const TickReport report = tick(state, *scene, settings, finger);
  ASSERT_EQ(report.contacts.size(), 2u);
  const double mean = (0.25 * 0.002 + 1 * 0.003) / 0.005;
  EXPECT_NEAR(((report.target - finger) - mean * (state.position - finger)).norm(), 0, 1e-12);
}

// C35: crossing from s1 to s2 at depth D injects 1/2 k (s2 - s1) D^2; the strict ledger refuses all of it.
TEST(Stiffness, CrossingToAHarderFloorInjectsTheFormula) {
  const auto scene = twoFloors(0.2, 0.9);
  const double depth = 0.002;
  for (const LedgerMode mode : {LedgerMode::kReport, LedgerMode::kTank, LedgerMode::kStrict}) {
    const ProxySettings settings = settingsOf(mode);
    ProxyState state = startProxy(*scene, settings, {-0.02, 0.01, 0});
    for (double x = -0.02; x < 0.02; x += 1e-4) tick(state, *scene, settings, {x, kRadius - depth, 0});
    const double expected = 0.5 * kK * (0.9 - 0.2) * depth * depth;
    if (mode == LedgerMode::kStrict) {
      EXPECT_LE(state.ledger.injected_J, 1e-12);
      // It may grow only by what the slide itself dissipates, 1/2 k s (0.1 mm)^2 a tick.
      EXPECT_LT(state.stiffness, 0.4);
    } else {
      EXPECT_NEAR(state.ledger.by_cause_J[static_cast<std::size_t>(EnergyCause::kStiffness)], expected,
                  1e-6 * expected);
      EXPECT_NEAR(state.stiffness, 0.9, 1e-12);
    }
  }
}

// Two floors in one place: whichever is given first, the harder counts, and of equally hard ones the rougher.
TEST(Stiffness, OfCoincidentSurfacesTheHarderCountsInAnyOrder) {
  const auto floors = [](const Material& first, const Material& second) {
    Model model = test::floorModel();
    test::addRectangle(model, {-0.1, 0, 0.1}, {0.2, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
    model.materials = {first, second};
    model.triangle_materials = {0, 0, 1, 1};
    return test::snapshotOf(std::move(model));
  };
  Material soft, hard, rough;
  soft.stiffness = 0.25;
  soft.dynamic_friction = 0.9;
  hard.stiffness = rough.stiffness = 0.75;
  rough.dynamic_friction = rough.static_friction = 0.5;
  const ProxySettings settings = settingsOf(LedgerMode::kReport);
  const auto pullAlong = [&](const Material& first, const Material& second) {
    const auto scene = floors(first, second);
    ProxyState state = startProxy(*scene, settings, {0.01, 0.01, 0});
    tick(state, *scene, settings, {0.01, -0.001, 0});
    tick(state, *scene, settings, {0.02, -0.001, 0});
    return std::pair(state.position.x(), state.stiffness);
  };
  EXPECT_EQ(pullAlong(soft, hard), std::pair(0.02, 0.75));
  EXPECT_EQ(pullAlong(hard, soft), std::pair(0.02, 0.75));
  EXPECT_EQ(pullAlong(rough, hard), pullAlong(hard, rough));
  EXPECT_LT(pullAlong(hard, rough).first, 0.0195);
}

// The same with an image of stiffness on one of them: what it says at the place decides, if images count at all.
TEST(Stiffness, OfCoincidentSurfacesTheOneThatIsHarderAtThePlaceCounts) {
  const auto floors = [](bool image_first, bool as_objects) {
    Texture ramp{"ramp", 2, 1, {0, 1}, Wrap::kClamp, Filter::kBilinear};
    std::vector<Model> parts(2, test::floorModel());
    parts[image_first ? 0 : 1].textures.push_back(ramp);
    parts[image_first ? 0 : 1].materials[0].textureOf(Quantity::kStiffness) = {0, 0, 1};
    parts[image_first ? 1 : 0].materials[0].stiffness = 0.7;
    std::vector<Instance> instances;
    for (Model& part : parts) {
      Instance& instance = instances.emplace_back();
      instance.shape = makeShape(std::move(part));
      instance.surfaces = surfacesOf(instance.shape);
      instance.key = instances.size();
    }
    if (as_objects) return makeSnapshot(std::move(instances));
    Model model = test::floorModel();
    test::addRectangle(model, {-0.1, 0, 0.1}, {0.2, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
    model.materials = {instances[0].surfaces->materials[0], instances[1].surfaces->materials[0]};
    model.triangle_materials = {0, 0, 1, 1};
    model.textures.push_back(ramp);
    return test::snapshotOf(std::move(model));
  };
  const auto felt = [](const Snapshot& scene, const ProxySettings& settings, double x) {
    ProxyState state = startProxy(scene, settings, {x, 0.01, 0.03});
    return tick(state, scene, settings, {x, 0, 0.03}).target.y() / kRadius;
  };
  const ProxySettings settings = settingsOf(LedgerMode::kReport);
  ProxySettings no_images = settings, set = settings;
  no_images.surfaces.textures = false;
  set.surfaces.stiffness = 0.3;
  for (const bool image_first : {true, false}) {
    for (const bool as_objects : {true, false}) {
      const auto scene = floors(image_first, as_objects);
      for (double x = -0.09; x < 0.09; x += 0.0037) {
        const double said = std::clamp(2 * ((x + 0.1) / 0.2 - 0.25), 0.0, 1.0);
        EXPECT_NEAR(felt(*scene, settings, x), std::max(0.7, said), 1e-6) << x << image_first << as_objects;
        EXPECT_NEAR(felt(*scene, no_images, x), 1, 1e-9) << x;
        EXPECT_NEAR(felt(*scene, set, x), 0.3, 1e-9) << x;
      }
    }
  }
}

// Edges, corners and faces of all directions, one material: what sends a proxy through the air within a tick.
std::shared_ptr<const Snapshot> ridges(double stiffness) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  Model model;
  const auto corner = [&] { return Vec3(0.02 * u(random), 0.02 * u(random), 0.02 * u(random)); };
  for (std::uint32_t i = 0; i < 40; ++i) {
    for (int k = 0; k < 3; ++k) model.positions.push_back(corner());
    model.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  model.materials[0].stiffness = stiffness;
  return test::snapshotOf(std::move(model));
}

// A tick that has to end before the proxy has come to rest, wherever that is, pulls no harder than the surface does and
// adds nothing; where it ends on its way from a surface, the servo goes on pulling.
TEST(Stiffness, ATickThatIsEndedEarlyIsAsSoftAsTheSurface) {
  constexpr double kSoft = 0.3;
  const auto scene = ridges(kSoft);
  int on_their_way = 0;
  for (int cap = 1; cap <= 12; ++cap) {
    ProxySettings settings = settingsOf(LedgerMode::kReport);
    settings.iteration_cap = cap;
    std::mt19937 random(static_cast<unsigned>(cap));
    std::uniform_real_distribution<double> u(-1, 1);
    ProxyState state = startProxy(*scene, settings, {0, 0, 0.05});
    for (int i = 0; i < 2000; ++i) {
      const Vec3 finger(0.02 * u(random), 0.02 * u(random), 0.02 * u(random));
      const bool touched = state.touching;
      const TickReport report = tick(state, *scene, settings, finger);
      const Vec3 whole = state.position - finger;
      ASSERT_LE((report.target - finger).norm(), kSoft * whole.norm() + 1e-12) << "tick " << i << ", cap " << cap;
      ASSERT_LE(report.injected_J, 1e-15) << "tick " << i << ", cap " << cap;
      if (!report.contacts.empty() || whole.norm() < 1e-9) continue;
      ++on_their_way;
      ASSERT_EQ(state.touching, touched || (report.target - finger).norm() > 0);
    }
  }
  EXPECT_GT(on_their_way, 100);
}

// Where nothing may be added a shaded proxy comes to rest, as on the true plane: it must not flip between two places
// of equal energy from tick to tick.
TEST(Ledger, WithoutEnergyTheProxyRestsInsteadOfFlipping) {
  const auto scene = test::snapshotOf(test::floorModel({0.42262, 0.90631, 0}));
  ProxySettings settings = settingsOf(LedgerMode::kStrict);
  settings.surfaces.smooth = true;
  ProxyState state = startProxy(*scene, settings, {0, 0.003, 0});
  tick(state, *scene, settings, {0, -0.002, 0});
  double ahead = 0, last_change = 0;  // of the finger, m
  int turns = 0;
  for (int i = 0; i < 60; ++i) {
    const double x = 3e-4 * std::max(0, i - 10);
    tick(state, *scene, settings, {x, -0.002, 0});
    const double change = state.position.x() - x - ahead;
    turns += change * last_change < -1e-14 ? 1 : 0;  // each more than 0.1 um
    last_change = change;
    ahead += change;
  }
  EXPECT_LE(turns, 2);
  EXPECT_LE(state.ledger.injected_J, 1e-12);
}

TEST(Ledger, TankPaysRefillsAndNeverOverflows) {
  Ledger ledger;
  EXPECT_EQ(ledger.budget_J(LedgerMode::kTank), kTankStart_J);
  EXPECT_EQ(ledger.budget_J(LedgerMode::kStrict), 0);
  ledger.book(0.004, true);
  EXPECT_NEAR(ledger.tank_J, 0.006, 1e-15);
  ledger.book(-0.001, false);
  EXPECT_NEAR(ledger.tank_J, 0.006, 1e-15);
  ledger.book(-1, true);
  EXPECT_EQ(ledger.tank_J, kTankFull_J);
  EXPECT_NEAR(ledger.injected_J, 0.004, 1e-15);
  EXPECT_NEAR(ledger.dissipated_J, 1.001, 1e-12);
}

// Triangles of every size and direction through each other, shaded by normals of their own, with textures of stiffness,
// friction and height.
std::shared_ptr<const Snapshot> soup(std::uint32_t triangles) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3(u(random), u(random), u(random)); };
  Model model;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 a = 0.05 * vec(), b = a + 0.02 * vec(), c = a + 0.02 * vec();
    const Vec3 face = (b - a).cross(c - a).normalized();
    for (const Vec3& p : {a, b, c}) {
      model.positions.push_back(p);
      model.normals.push_back((face + 0.7 * vec()).normalized());
      model.texcoords.emplace_back(3 * u(random), 3 * u(random));
    }
    model.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  model.textures = {makeTexture("noise", 16), makeTexture("checker", 8), makeTexture("sine", 32)};
  Material& material = model.materials[0];
  material.smooth = true;
  material.dynamic_friction = 0.2;
  material.textureOf(Quantity::kStiffness) = {0, 0.1, 1};
  material.textureOf(Quantity::kStaticFriction) = {1, 0.1, 0.8};
  material.textureOf(Quantity::kHeight) = {2, 0, 2e-4};
  return makeSnapshot(std::move(model), HierarchyKind::kBvh);
}

struct Walk {
  double most_per_tick_J = -1e9;
  double least_clearance = 1e9;
  double most_over_tank_J = -1e9;  // net energy added since the start, beyond the tank's 10 mJ
  Ledger ledger;
};

Walk randomWalk(const Snapshot& scene, const ProxySettings& settings, int ticks) {
  std::mt19937 random(5);
  std::normal_distribution<double> jump(0, 3e-4);
  Vec3 finger(0, 0, 0.06), velocity = Vec3::Zero();
  ProxyState state = startProxy(scene, settings, finger);
  Walk walk;
  double net_touching_J = 0;
  for (int i = 0; i < ticks; ++i) {
    velocity = 0.97 * velocity + 0.2 * Vec3(jump(random), jump(random), jump(random)) - 1e-3 * finger;
    finger += velocity;
    const double before_J = 0.5 * kK * state.stiffness * (state.position - finger).squaredNorm();
    const bool was_touching = state.touching;
    const TickReport report = tick(state, scene, settings, finger);
    const double after_J = 0.5 * kK * (report.target - finger).dot(state.position - finger);
    if (was_touching && state.touching) {
      walk.most_per_tick_J = std::max(walk.most_per_tick_J, after_J - before_J);
      net_touching_J += after_J - before_J;
      walk.most_over_tank_J = std::max(walk.most_over_tank_J, net_touching_J - kTankStart_J);
    }
    if (i % 10 == 0)
      walk.least_clearance = std::min(walk.least_clearance, judge::clearance(scene, state.position, 2 * kRadius));
  }
  walk.ledger = state.ledger;
  return walk;
}

#ifdef HL_SANITIZED
constexpr int kWalkTicks = 20'000;
#else
constexpr int kWalkTicks = 1'000'000;
#endif

// The order in which triangles come, and the structure that finds them, change no bit of any effect.
TEST(Ledger, TheSameBitsWhateverTheOrderOfTheTriangles) {
  const auto scene = soup(300);
  Model shuffled = scene->shape().model;
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(9));
  const auto other = makeSnapshot(std::move(shuffled), HierarchyKind::kNone);
  ProxySettings settings = settingsOf(LedgerMode::kTank);
  settings.work_cap = kNoWorkCap;
  const Walk a = randomWalk(*scene, settings, 5000), b = randomWalk(*other, settings, 5000);
  EXPECT_EQ(a.ledger.injected_J, b.ledger.injected_J);
  EXPECT_EQ(a.ledger.dissipated_J, b.ledger.dissipated_J);
  EXPECT_EQ(a.ledger.by_cause_J, b.ledger.by_cause_J);
}

TEST(Ledger, TicksWithEveryEffectDoNotAllocate) {
  const auto scene = soup(300);
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  ProxyState state = startProxy(*scene, settings, {0, 0, 0.06});
  const RealtimeGuard guard;
  for (int i = 0; i < 2000; ++i) {
    const double t = 1e-3 * i;
    tick(state, *scene, settings, 0.05 * Vec3(std::sin(7 * t), std::sin(5 * t + 1), std::cos(3 * t)));
  }
}

TEST(Ledger, StrictTicksNeverAddEnergyOverASoupOfEverything) {
  const auto scene = soup(300);
  const Walk walk = randomWalk(*scene, settingsOf(LedgerMode::kStrict), kWalkTicks);
  EXPECT_LE(walk.most_per_tick_J, 1e-12);
  EXPECT_GE(walk.least_clearance, kRadius * (1 - 1e-6));
  EXPECT_LE(walk.ledger.injected_J, 1e-12 * kWalkTicks);
  EXPECT_GT(walk.ledger.dissipated_J, 0);
}

TEST(Ledger, TheTankBoundsWhatIsAdded) {
  const auto scene = soup(300);
  const Walk walk = randomWalk(*scene, settingsOf(LedgerMode::kTank), kWalkTicks / 4);
  EXPECT_LE(walk.most_over_tank_J, 1e-9);
  EXPECT_LE(walk.most_per_tick_J, kTankFull_J + 1e-9);
  EXPECT_GE(walk.least_clearance, kRadius * (1 - 1e-6));
  EXPECT_GT(walk.ledger.injected_J, 0);
  const Walk free = randomWalk(*scene, settingsOf(LedgerMode::kReport), kWalkTicks / 4);
  EXPECT_GT(free.ledger.injected_J, walk.ledger.injected_J);
}

}  // namespace
}  // namespace hl::test_stiffness
