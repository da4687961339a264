// A page that has gone lets go, however it went: hand and buttons.
#include <gtest/gtest.h>
#include <hl.pb.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "http/http_server.h"
#include "page/page_holds.h"
#include "page/viewer_feed.h"
#include "plain_client.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_page_holds {
namespace {

// A floor through the origin of the device.
std::shared_ptr<const Snapshot> floor() {
  Model model;
  model.positions = {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1)};
  model.triangles = {{0, 2, 1}, {0, 3, 2}};
  return makeSnapshot(std::move(model));
}

class PageThatHolds : public testing::Test {
 protected:
  PageThatHolds() : session_(floor(), settings()), server_(http(), makeViewerFeed(session_, "test")) {
    session_.start();
    server_.start();
    page_.emplace(server_.port(), test::Headers{}, "/viewer");
    goal_.mutable_hand_goal()->mutable_position()->set_y(-0.015 * session_.live().workspace().world_per_device);
    press_.mutable_press()->set_buttons(2);
  }
  static TouchSettings settings() {
    TouchSettings settings;
    settings.explore = false;
    return settings;
  }
  static HttpServerSettings http() {
    HttpServerSettings settings;
    settings.port = 0;
    return settings;
  }
  // Says again what it holds, as pages do.
  void holdUntilFelt() {
    test::waitFor([&] {
      page_->sendBinary(goal_.SerializeAsString());
      page_->sendBinary(press_.SerializeAsString());
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (servo().safety == SafetyState::kFault) session_.live().rearm();  // a busy machine may hold the servo up
      return servo().force_N.norm() > 1 && servo().buttons == 2;
    });
  }
  ServoView servo() { return test::servoOf(session_); }
  void waitUntilLetGo() {
    test::waitFor([&] { return servo().force_N.norm() < 0.3 && servo().buttons == 0; });
  }

  TouchSession session_;
  HttpServer server_;
  std::optional<test::PlainClient> page_;
  proto::ViewerMessage goal_, press_;
};

TEST_F(PageThatHolds, AndIsClosedWithoutACloseFrameLetsGo) {
  holdUntilFelt();
  page_.reset();
  waitUntilLetGo();
}

TEST_F(PageThatHolds, AndFallsSilentLetsGo) {
  holdUntilFelt();
  waitUntilLetGo();
}

// Without a word of its own a page that is still there keeps what it holds.
TEST_F(PageThatHolds, AndSaysThatItIsThereKeepsTheHand) {
  holdUntilFelt();
  for (int i = 0; i < 50; ++i) {
    page_->sendBinary("");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_TRUE(servo().force_N.norm() > 1 || servo().safety == SafetyState::kFault) << servo().force_N.norm();
}

// The hand of somebody else is not let go of.
TEST(PageHolds, GoWithTheirOwnPageAlone) {
  std::vector<std::size_t> left;
  PageHolds holds([&](std::size_t device, PageHolds::What) { left.push_back(device); });
  holds.hear(1, 0);
  holds.hear(2, 0);
  holds.take(1, 0, PageHolds::What::kHand);
  holds.take(1, 1, PageHolds::What::kHand);
  holds.take(1, 2, PageHolds::What::kHand);
  holds.take(2, 0, PageHolds::What::kHand);
  holds.leave(2, PageHolds::What::kHand);
  holds.gone(1);
  EXPECT_EQ(left, std::vector<std::size_t>{1});
  holds.letGoOfSilent(PageHolds::silent_ns(PageHolds::What::kHand));
  EXPECT_EQ(left.size(), 1U);
  holds.letGoOfSilent(PageHolds::silent_ns(PageHolds::What::kHand) + 1);
  EXPECT_EQ(left, (std::vector<std::size_t>{1, 0}));
}

}  // namespace
}  // namespace hl::test_page_holds
