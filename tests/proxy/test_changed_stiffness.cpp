// A stiffness that a client, or the user, changes while the surface is touched is felt from then on, whatever the tank
// holds.
#include "proxy/changed_stiffness.h"

#include <gtest/gtest.h>

#include <memory>

#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"

namespace hl::test_changed_stiffness {
namespace {

constexpr double kK = 1000;
constexpr double kDepth_m = 0.005;

std::shared_ptr<const Snapshot> floorOf(const Material& material, std::uint64_t number, std::uint64_t key = 1) {
  Instance floor;
  floor.shape = makeShape(test::floorModel(), HierarchyKind::kBvh);
  auto surfaces = std::make_shared<Surfaces>(*surfacesOf(floor.shape));
  surfaces->materials.assign(1, material);
  floor.surfaces = std::move(surfaces);
  floor.key = key;
  return makeSnapshot({floor}, {}, number);
}

std::shared_ptr<const Snapshot> floorOf(double stiffness, std::uint64_t number, std::uint64_t key = 1) {
  Material material;
  material.stiffness = stiffness;
  return floorOf(material, number, key);
}

ProxySettings settingsOf(LedgerMode ledger) {
  ProxySettings settings;
  settings.radius = 0;
  settings.spring_N_m = kK;
  settings.ledger = ledger;
  return settings;
}

double forceAt(ProxyState& state, const Snapshot& scene, const ProxySettings& settings, double x_m = 0) {
  const Vec3 finger(x_m, -kDepth_m, 0);
  return kK * (tick(state, scene, settings, finger).target - finger).norm();
}

ProxyState pressed(const Snapshot& scene, const ProxySettings& settings) {
  ProxyState state = startProxy(scene, settings, {0, 0.01, 0});
  for (int i = 0; i < 100; ++i) tick(state, scene, settings, {0, 0.01 - i * 1.5e-4, 0});
  forceAt(state, scene, settings);
  return state;
}

TEST(ChangedStiffness, OfAClientIsFeltAtOnceAndCostsTheTankNothing) {
  for (const LedgerMode ledger : {LedgerMode::kTank, LedgerMode::kStrict, LedgerMode::kReport}) {
    const ProxySettings settings = settingsOf(ledger);
    const auto soft = floorOf(0.1, 1), hard = floorOf(1, 2), middle = floorOf(0.4, 3);
    ProxyState state = pressed(*soft, settings);
    EXPECT_NEAR(forceAt(state, *soft, settings), 0.1 * kK * kDepth_m, 1e-9);
    const double tank_J = state.ledger.tank_J;
    EXPECT_NEAR(forceAt(state, *hard, settings), kK * kDepth_m, 1e-9);
    EXPECT_EQ(state.ledger.tank_J, tank_J);
    EXPECT_NEAR(state.ledger.by_cause_J[static_cast<std::size_t>(EnergyCause::kMoving)],
                0.9 * 0.5 * kK * kDepth_m * kDepth_m, 1e-9);
    EXPECT_NEAR(forceAt(state, *hard, settings, 0.001), kK * std::hypot(kDepth_m, 0), 1e-9);
    EXPECT_NEAR(forceAt(state, *middle, settings, 0.001), 0.4 * kK * kDepth_m, 1e-9);
  }
}

TEST(ChangedStiffness, OfTheUserToo) {
  ProxySettings settings = settingsOf(LedgerMode::kStrict);
  const auto scene = floorOf(0.1, 1);
  ProxyState state = pressed(*scene, settings);
  settings.surfaces.stiffness = 0.7;
  EXPECT_NEAR(forceAt(state, *scene, settings), 0.7 * kK * kDepth_m, 1e-9);
  settings.surfaces.stiffness.reset();
  EXPECT_NEAR(forceAt(state, *scene, settings), 0.1 * kK * kDepth_m, 1e-9);
  settings.surfaces.stiffness = 0;
  EXPECT_EQ(forceAt(state, *scene, settings), 0);
  settings.surfaces.stiffness = 0.2;
  EXPECT_NEAR(forceAt(state, *scene, settings), 0.2 * kK * kDepth_m, 1e-9);
}

// 1 / (K s) = 1 / (K s0) + C, with the new s0.
TEST(ChangedStiffness, OfASurfaceThatYields) {
  const ProxySettings settings = settingsOf(LedgerMode::kStrict);
  Material material;
  material.compliance_m_N = 0.001;
  material.stiffness = 0.2;
  const auto soft = floorOf(material, 1);
  material.stiffness = 1;
  const auto hard = floorOf(material, 2);
  ProxyState state = pressed(*soft, settings);
  EXPECT_NEAR(forceAt(state, *soft, settings), kDepth_m / (1 / (0.2 * kK) + 0.001), 1e-9);
  EXPECT_NEAR(forceAt(state, *hard, settings), kDepth_m / (1 / kK + 0.001), 1e-9);
}

// Another object in the place of the first is no surface that has changed.
TEST(ChangedStiffness, OfAnotherObjectIsNone) {
  const ProxySettings settings = settingsOf(LedgerMode::kStrict);
  const auto soft = floorOf(0.1, 1), other = floorOf(1, 2, 9);
  ProxyState state = pressed(*soft, settings);
  EXPECT_NEAR(forceAt(state, *other, settings), 0.1 * kK * kDepth_m, 1e-9);
}

TEST(ChangedStiffness, IsRealTimeSafe) {
  const ProxySettings settings = settingsOf(LedgerMode::kTank);
  const auto soft = floorOf(0.1, 1), hard = floorOf(1, 2);
  ProxyState state = pressed(*soft, settings);
  const RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) forceAt(state, i % 2 == 0 ? *hard : *soft, settings);
}

}  // namespace
}  // namespace hl::test_changed_stiffness
