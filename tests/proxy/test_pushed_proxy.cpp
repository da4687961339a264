// The proxy between two ticks: what may take it along, and where that takes it.
#include "proxy/pushed_proxy.h"

#include <gtest/gtest.h>

#include "moving_scenes.h"

namespace hl::test_pushed_proxy {
namespace {

constexpr double kRadius = 0.002;
constexpr std::int64_t kMs = 1'000'000;

PushedProxy proxyIn(const SceneAt& at_end, const Vec3& position, std::uint32_t carrier) {
  return {at_end, Tolerances::of(kRadius, at_end.extent()), 2 * kMs, position, carrier};
}

TEST(PushedProxy, OnlyWhatMovesOrBendsTakesItAlong) {
  const Motion moving = Motion().then(test::at({0, 0.1, 0}), 0, kMs);
  const auto scene =
      makeSnapshot({test::place(3, test::flatSheet(0), Motion()), test::place(5, test::flatSheet(0), moving),
                    test::deforming(7, test::flatSheet(0), test::flatSheet(0.01), 0, kMs)});
  EXPECT_EQ(movingInstance(*scene, 5), 1u);
  EXPECT_EQ(movingInstance(*scene, 7), 2u);
  for (const std::uint64_t key : {0, 3, 4, 6, 8}) EXPECT_EQ(movingInstance(*scene, key), kNoInstance) << key;
}

TEST(PushedProxy, WithoutACarrierItStandsStill) {
  const Motion moving = Motion().then(test::at({0, 0.1, 0}), 0, 10 * kMs);
  const auto scene = makeSnapshot({test::place(1, test::flatSheet(0), moving)});
  const Vec3 place(0, 0.02 + kRadius, 0);
  EXPECT_EQ(proxyIn({*scene, 10 * kMs}, place, kNoInstance).carriedTo(10 * kMs), place);
}

TEST(PushedProxy, ACarrierThatMovesKeepsItWhereItIsInItsFrame) {
  const Pose end{Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), Vec3(0.01, 0.02, -0.03)};
  const Motion moving = Motion().then(end, 0, 10 * kMs);
  const auto scene = makeSnapshot({test::place(1, test::flatSheet(0), moving)});
  const Vec3 own(0.003, kRadius, -0.004);
  const SceneAt at_end(*scene, 10 * kMs);
  const PushedProxy proxy = proxyIn(at_end, moving.at(2 * kMs).toWorld(own), 0);
  for (const std::int64_t t : {3 * kMs, 10 * kMs})
    EXPECT_NEAR((moving.at(t).toObject(proxy.carriedTo(t)) - own).norm(), 0, 1e-15);
}

// A sheet that is drawn along x by 2 mm and lifted by 4 mm, in 10 ms.
TEST(PushedProxy, AMeshThatBendsTakesItWhereTheTouchedPlaceGoes) {
  Model drawn = test::flatSheet(0.004);
  for (Vec3& p : drawn.positions) p.x() += 0.002;
  const auto scene = makeSnapshot({test::deforming(1, test::flatSheet(0), drawn, 0, 10 * kMs)});
  const Vec3 touching(0.0013, 0.0008 + 1.05 * kRadius, 0.0007), beyond = touching + Vec3(0, 0.1 * kRadius, 0);
  EXPECT_NEAR((proxyIn({*scene, 10 * kMs}, touching, 0).carriedTo(7 * kMs) - touching - Vec3(0.001, 0.002, 0)).norm(),
              0, 1e-12);
  EXPECT_EQ(proxyIn({*scene, 10 * kMs}, beyond, 0).carriedTo(7 * kMs), beyond) << "what it does not touch leaves it";
}

TEST(PushedProxy, OfTwoPlacesTouchedTheNearestDecides) {
  // A slope whose upper part goes aside faster.
  const auto slope = [](double by) {
    Model model = test::sheet([](double x, double) { return 0.5 * x; });
    for (Vec3& p : model.positions) p.z() += by * (p.x() + 0.05);
    return model;
  };
  const auto scene = makeSnapshot({test::deforming(1, slope(0), slope(0.1), 0, 10 * kMs)});
  const Vec3 normal = Vec3(-0.5, 1, 0).normalized(), foot(0.0096, 0.0048, 0.0021);
  const SceneAt at_end(*scene, 10 * kMs);
  const PushedProxy proxy = proxyIn(at_end, foot + kRadius * normal, 0);
  // From 2 to 10 ms: 8/10 of 0.1 (x + 0.05). The triangles beyond x = 0.01 are touched too.
  EXPECT_NEAR(proxy.carriedTo(10 * kMs).z() - proxy.position.z(), 0.08 * 0.0596, 1e-9);
}

}  // namespace
}  // namespace hl::test_pushed_proxy
