// What the estimate of the compliance sees of a mesh that deforms.
#include "proxy/follow_deformation.h"

#include <gtest/gtest.h>

#include "moving_scenes.h"

namespace hl::test_follow_deformation {
namespace {

constexpr std::int64_t kMs = 1'000'000;

Model triangleOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  Model model;
  model.positions = {a, b, c};
  model.triangles = {{0, 1, 2}};
  return model;
}

// m along y, that the place of the weights 0.2, 0.3, 0.5 has gone from `from_ns` to `to_ns`. Its corners rise by 1, 2
// and 3 mm in 10 ms, while the last goes over the line between the others: halfway it is on it.
double movedUp(std::int64_t from_ns, std::int64_t to_ns) {
  const Model flat = triangleOf({0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0.1});
  const Model risen = triangleOf({0, 0.001, 0}, {0.1, 0.002, 0}, {0.2, 0.003, -0.1});
  const auto scene = makeSnapshot({test::deforming(1, flat, risen, 0, 10 * kMs)});
  ProxyState state;
  state.snapshot = scene->number;
  state.time_ns = from_ns;
  state.estimate.key = 1;
  state.estimate.geometry = scene->instances[0].shape->geometry;
  state.estimate.weights = {0.2, 0.3, 0.5};
  state.estimate.normal = Vec3::UnitY();
  const ProxySettings settings;
  followDeformation(state, SceneAt(*scene, to_ns), settings);
  return state.estimate.moved_m;
}

TEST(FollowDeformation, ThePlaceGoesWithItsCorners) {
  EXPECT_NEAR(movedUp(2 * kMs, 3 * kMs), 0.1 * (0.2 * 0.001 + 0.3 * 0.002 + 0.5 * 0.003), 1e-15);
  EXPECT_NEAR(movedUp(6 * kMs, 9 * kMs), 0.3 * (0.2 * 0.001 + 0.3 * 0.002 + 0.5 * 0.003), 1e-15);
}

// Of a triangle that has become a line the corners have another order: the weights are none of them.
TEST(FollowDeformation, APlaceOfATriangleThatHasBecomeALineIsNotKnown) { EXPECT_EQ(movedUp(2 * kMs, 5 * kMs), 0); }

}  // namespace
}  // namespace hl::test_follow_deformation
