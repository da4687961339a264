// The snap board: its blocks stand still, and every snap of it can be reached and holds.
#include <gtest/gtest.h>

#include "proxy/proxy.h"
#include "snap_board.h"
#include "touch/body_world.h"

namespace hl::test_snap_board {
namespace {

TEST(SnapBoard, BlocksStandStillUntilTheyAreTouched) {
  const auto world = BodyWorld::of(*makeSnapshot(makeSnapBoard()));
  const Vec3 begin = world->state().bodies[0].centre;
  for (int i = 1; i <= 2000; ++i) world->step(i * 1'000'000, 1e-3, {});
  EXPECT_LT((world->state().bodies[0].centre - begin).norm(), 1e-4);
  EXPECT_EQ(world->view().awake, 0U);
}

// From every snap's first and middle point, at the radius that the proxy has there in `hl touch snaps`.
TEST(SnapBoard, EverySnapHoldsAFingerOnIt) {
  const auto scene = makeSnapshot(makeSnapBoard());
  ProxySettings settings;
  settings.radius = 0.0037;
  settings.spring_N_m = 500;
  ASSERT_EQ(scene->snaps.size(), 6U);
  for (const PlacedSnap& each : scene->snaps) {
    const Instance& instance = scene->instances[each.instance];
    const SnapSpec& snap = (*instance.snaps)[each.number];
    for (const std::size_t corner : {std::size_t{0}, snap.points.size() / 2}) {
      const Vec3 place = instance.shownAt(0).toWorld(snap.points[corner]);
      ProxyState state = startProxy(*scene, settings, place + Vec3(0, 0.05, 0));
      for (int i = 0; i < 100; ++i) tick(state, *scene, settings, place + Vec3(0, 0.05 - 0.0005 * (i + 1), 0));
      EXPECT_TRUE(state.snap.holds()) << snap.name;
      EXPECT_EQ(state.snap.key, instance.key) << snap.name;
      EXPECT_EQ(state.snap.number, each.number) << snap.name;
    }
  }
}

}  // namespace
}  // namespace hl::test_snap_board
