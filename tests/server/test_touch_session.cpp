// A whole session on the real clock: the exploring hand touches the teapot, the proxy stays outside, forces are
// bounded.
#include "server/touch_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "builtin.h"
#include "geometry/queries.h"
#include "server/viewer_feed.h"

namespace hl {
namespace {

double clearance(const Snapshot& scene, const Vec3& p, double reach) {
  double nearest = reach;
  SceneAt(scene).primitivesWithin(p, reach,
                                  [&](PrimitiveId, const ClosestPoint& c) { nearest = std::min(nearest, c.distance); });
  return nearest;
}

TEST(C65TouchSession, TheExploringHandTouchesAndTheProxyShownStaysOutside) {
  const auto snapshot = makeSnapshot(makeBuiltinScene("teapot"), HierarchyKind::kBvh);
  TouchSession session(snapshot, {});
  session.start();
  double strongest = 0;
  for (int i = 0; i < 300; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ServoView servo;
    ProxyView proxy;
    session.views(servo, proxy);
    ASSERT_TRUE(servo.force_N.allFinite());
    ASSERT_LE(servo.force_N.norm(), session.deviceInfo().force_max_N * (1 + 1e-9));
    if (proxy.loop.rate_Hz > 0) {
      ASSERT_GE(clearance(*snapshot, proxy.proxy, session.radius_W()), session.radius_W() * (1 - 1e-6));
    }
    strongest = std::max(strongest, servo.force_N.norm());
  }
  session.stop();
  EXPECT_GT(strongest, 0.2);
  EXPECT_GT(session.servoTotals().steps, 1000u);
}

TEST(TouchSession, APersonTakesOverAndThePressIsFelt) {
  const auto snapshot = makeSnapshot(makeBuiltinScene("plane:2000"), HierarchyKind::kBvh);
  TouchSettings settings;
  settings.explore = false;
  TouchSession session(snapshot, settings);
  session.start();
  session.setHandGoal(Vec3(0, -0.02, 0));
  double strongest = 0;
  for (int i = 0; i < 200 && strongest < 0.5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ServoView servo;
    ProxyView proxy;
    session.views(servo, proxy);
    strongest = std::max(strongest, servo.force_N.y());
  }
  EXPECT_GT(strongest, 0.5);
  EXPECT_FALSE(session.exploring());
}

// A first world is fitted to the hand: around the origin of the device, where nobody waits for it.
TEST(TouchSession, AFirstWorldAppearsBesideTheFingerNotAroundIt) {
  for (const bool explore : {false, true}) {
    TouchSettings settings;
    settings.explore = explore;
    TouchSession session(makeSnapshot(std::vector<Instance>{}), settings);
    session.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const auto world = makeSnapshot(makeBuiltinScene("sphere:500"), HierarchyKind::kBvh);
    session.publish(world);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ProxyView proxy;
    ServoView servo;
    session.views(servo, proxy);
    EXPECT_GT((proxy.proxy - world->bounds.centre()).norm(), 0.4 * world->bounds.size().minCoeff())
        << proxy.proxy.transpose();
  }
}

TEST(TouchSession, BadCommandsChangeNothing) {
  const auto snapshot = makeSnapshot(makeBuiltinScene("plane:200"), HierarchyKind::kBvh);
  TouchSession session(snapshot, {});
  const double before = session.stiffness_N_m();
  session.setStiffness(-1);
  session.setStiffness(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(session.stiffness_N_m(), before);
  session.setStiffness(1e9);
  EXPECT_EQ(session.stiffness_N_m(), session.deviceInfo().stiffness_max_N_m);
  FeedCallbacks feed = makeViewerFeed(session, "test");
  feed.receive("\xff\xff garbage");
  EXPECT_FALSE(feed.hello().empty());
}

}  // namespace
}  // namespace hl
