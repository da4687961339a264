// A whole session on the real clock: the exploring hand touches the teapot, the proxy stays outside, forces are
// bounded.
#include "touch/touch_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "block_scenes.h"
#include "builtin.h"
#include "geometry/queries.h"
#include "page/viewer_feed.h"
#include "session/state_messages.h"
#include "session/stylus_messages.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_touch_session {
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
      ASSERT_GE(clearance(*snapshot, proxy.proxy, session.live().radius_W()), session.live().radius_W() * (1 - 1e-6));
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
  session.hand().setGoal(Vec3(0, -0.02, 0));
  double strongest = 0;
  for (int i = 0; i < 200 && strongest < 0.5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ServoView servo;
    ProxyView proxy;
    session.views(servo, proxy);
    strongest = std::max(strongest, servo.force_N.y());
  }
  EXPECT_GT(strongest, 0.5);
  EXPECT_FALSE(session.hand().exploring());
}

// A busy machine may hold the servo up, which is a fault: then a person arms again.
ServoView armedServoOf(TouchSession& session) {
  const ServoView servo = test::servoOf(session);
  if (servo.safety == SafetyState::kFault) session.live().rearm();
  return servo;
}

TEST(TouchSession, AButtonHeldOnThePageIsADeadMansSwitchAndComesUpWhenThePageHasGone) {
  TouchSettings settings;
  settings.explore = false;
  settings.servo.dead_man = DeadMan::kButton;
  settings.servo.dead_man_button = 2;
  TouchSession session(makeSnapshot(makeBuiltinScene("plane:2000"), HierarchyKind::kBvh), settings);
  session.start();
  const FeedCallbacks page = makeViewerFeed(session, "test");
  session.hand().setGoal(Vec3(0, -0.02, 0));
  test::waitFor([&] {
    const ServoView servo = armedServoOf(session);
    return servo.safety == SafetyState::kWaiting && servo.finger_D.y() < -0.001 && servo.force_N.isZero(0);
  });
  proto::ViewerMessage message;
  message.mutable_press()->set_buttons(1U << 2);
  test::waitFor([&] {
    page.receive(1, message.SerializeAsString());
    const ServoView servo = armedServoOf(session);
    return servo.safety == SafetyState::kOn && servo.buttons == 1U << 2;
  });
  test::waitFor([&] {
    const ServoView servo = armedServoOf(session);
    return servo.safety == SafetyState::kWaiting && servo.buttons == 0;
  });
  session.stop();
}

// From the page to the wrist of the device, and from its encoders to the page and to clients: the same bits.
TEST(TouchSession, APageTurnsTheStylusAndSeesHowItIsTurned) {
  TouchSettings settings;
  settings.explore = false;
  TouchSession session(makeSnapshot(makeBuiltinScene("plane:2000"), HierarchyKind::kBvh), settings,
                       openDevice("sim:omega7"));
  session.start();
  const FeedCallbacks page = makeViewerFeed(session, "test");
  const Eigen::Quaterniond goal = Eigen::Quaterniond(0.5, -0.7, 0.2, 0.4).normalized();
  proto::ViewerMessage message;
  proto::Rotation& turned = *message.mutable_hand_turn()->mutable_rotation();
  toProto(Eigen::Quaterniond(-3 * goal.coeffs()), turned);
  message.mutable_hand_turn()->set_gripper_rad(0.3);
  proto::Stylus shown;
  test::waitFor([&] {
    page.receive(1, message.SerializeAsString());
    proto::ServerMessage state;
    if (!state.ParseFromString(page.state()) || !state.state().has_stylus()) return false;
    shown = state.state().stylus();
    return turnOf(shown.rotation()).angularDistance(goal) < 0.005 && std::abs(shown.gripper_rad() - 0.3) < 1e-3;
  });
  ServoView pages, clients;
  ProxyView proxy;
  const auto settled = [&] {  // the hand has come to rest: pages and clients are sent the same
    session.views(pages, proxy);
    session.viewsForClients(clients, proxy);
    return pages.stylus.turned.coeffs() == clients.stylus.turned.coeffs();
  };
  test::waitFor(settled);
  EXPECT_LT(turnOf(shown.rotation()).angularDistance(pages.stylus.turned), 0.005);
  for (const double part : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    turned.set_x(part), turned.set_y(part), turned.set_z(part), turned.set_w(part);
    page.receive(1, message.SerializeAsString());
  }
  test::waitFor(settled);
  EXPECT_LT(pages.stylus.turned.angularDistance(goal), 0.005);
  session.stop();
}

TEST(ServoRate, IsTheDevicesOwnUnlessOneIsGivenOrTheHighestThatHoldsIsWanted) {
  DeviceInfo device;
  device.servo_rate_Hz = 1000;
  device.servo_rate_max_Hz = 4000;
  EXPECT_EQ(ServoRate{}.of(device), 1000);
  EXPECT_EQ((ServoRate{2500, false}.of(device)), 2500);
  std::vector<double> tried;
  const auto upTo = [&](double most_Hz) {
    tried.clear();
    return highestServoRate_Hz(device, [&](double rate_Hz) {
      tried.push_back(rate_Hz);
      return rate_Hz <= most_Hz;
    });
  };
  EXPECT_EQ(upTo(1e5), 4000);
  EXPECT_EQ(tried, (std::vector<double>{4000}));
  EXPECT_EQ(upTo(3000), 2000);
  EXPECT_EQ(upTo(0), 1000);
  EXPECT_EQ(tried, (std::vector<double>{4000, 2000}));
  device.servo_rate_max_Hz = device.servo_rate_Hz = 500;
  EXPECT_EQ(upTo(1e5), 500);
  EXPECT_TRUE(tried.empty());
}

// The thread that moves the hand looks at bodies that the servo moves: ThreadSanitizer sees whether it may.
TEST(TouchSession, TheHandExploresWhileBodiesMove) {
  std::vector<test::Block> blocks(8);
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].at = Vec3(0.05 * static_cast<double>(i) - 0.2, 0.2, 0);
  const auto scene = test::sceneOfBlocks(blocks, 0.3, 9.81);
  TouchSession session(scene, {});
  session.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_TRUE(session.hand().exploring());
  EXPECT_LT(scene->instances[1].body->poses->shown().pose.origin.y(), 0.19) << "it has fallen";
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

TEST(TouchSession, EachTickIsCountedByWhyItEndedAndPagesAndClientsGetTheCounts) {
  TouchSession session(makeSnapshot(makeBuiltinScene("plane:200"), HierarchyKind::kBvh), {});
  session.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  session.stop();
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  std::uint64_t ticks = 0;
  proxy.ended.each([&](Ending, std::uint64_t count) { ticks += count; });
  EXPECT_GT(ticks, 0u);
  EXPECT_EQ(ticks, session.proxyTotals().steps);

  proxy.ended.add(Ending::kOutOfWork);
  proto::ClientState client;
  toProto(session, servo, proxy, client);
  EXPECT_EQ(client.ticks_ended().reached(), proxy.ended[Ending::kReached]);
  EXPECT_EQ(client.ticks_ended().out_of_work(), proxy.ended[Ending::kOutOfWork]);
  proto::ServerMessage page;
  ASSERT_TRUE(page.ParseFromString(makeViewerFeed(session, "test").state()));
  EXPECT_EQ(page.state().ticks_ended().reached(), proxy.ended[Ending::kReached]);
}

TEST(TouchSession, BadCommandsChangeNothing) {
  const auto snapshot = makeSnapshot(makeBuiltinScene("plane:200"), HierarchyKind::kBvh);
  TouchSession session(snapshot, {});
  const double before = session.live().stiffness_N_m();
  session.live().setStiffness(-1);
  session.live().setStiffness(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(session.live().stiffness_N_m(), before);
  session.live().setStiffness(1e9);
  EXPECT_EQ(session.live().stiffness_N_m(), session.deviceInfo().stiffness_max_N_m);
  FeedCallbacks feed = makeViewerFeed(session, "test");
  feed.receive(1, "\xff\xff garbage");
  EXPECT_FALSE(feed.hello().empty());
}

}  // namespace
}  // namespace hl::test_touch_session
