// A server with several devices: each has its own name, proxy, servo and watchdog. Faults stay apart, or are joined.
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "device/fakes/twin_bench.h"
#include "monitor/touch_monitor.h"
#include "page/viewer_feed.h"
#include "session/touch_server.h"
#include "touch/fault_group.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test::test_several_devices {
namespace {

std::shared_ptr<const Snapshot> emptyScene() { return makeSnapshot(std::vector<Instance>{}); }

std::string refusalOf(const TouchServerSettings& settings) {
  try {
    TouchServer server(emptyScene(), settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class SeveralDevices : public testing::Test {
 protected:
  SeveralDevices() {
    for (const TwinKind& kind : twinKinds()) {
      if (kind.name == "DhdByIndex") bench_ = kind.make();
    }
  }
  void start(bool joined, bool arm_again = false) {
    TouchServerSettings settings;
    settings.devices = {{"left", "dhd:0"}, {"right", "dhd:1"}};
    settings.faults_joined = joined;
    settings.touch.servo.arm_again = arm_again;
    server_ = std::make_unique<TouchServer>(emptyScene(), settings);
    server_->start();
    waitFor([this] { return isOn(0) && isOn(1); });
  }
  ServoView servo(std::size_t number) { return servoOf(server_->device(number)); }
  // A busy machine may cause a fault of its own, which is not what is tested: then a person arms again.
  bool isOn(std::size_t number) {
    const bool own = servo(number).safety == SafetyState::kFault && !bench_->arm(number).lost;
    if (own && !(bench_->arm(0).lost || bench_->arm(1).lost)) server_->device(number).live().rearm();
    return servo(number).safety == SafetyState::kOn;
  }
  bool isInFault(std::size_t number, FaultReason reason) {
    return servo(number).safety == SafetyState::kFault && servo(number).fault == reason;
  }

  std::unique_ptr<TwinBench> bench_;
  std::unique_ptr<TouchServer> server_;
};

TEST_F(SeveralDevices, HaveTheirNamesInTheOrderInWhichTheyWereGiven) {
  start(false);
  ASSERT_EQ(server_->devices(), 2U);
  EXPECT_EQ(server_->device(0).label().name, "left");
  EXPECT_EQ(server_->device(1).label().name, "right");
  EXPECT_EQ(server_->device(1).label().number, 1U);
}

std::string lineWith(const std::string& text, const std::string& head) {
  const std::size_t at = text.find("\n" + head);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

// Number or name: the same device.
TEST_F(SeveralDevices, AClientChoosesItsDeviceByNumberOrByName) {
  start(false);
  const auto open = [&](std::uint32_t number, const std::string& label) {
    proto::ClientMessage message;
    message.mutable_open()->set_protocol_version(1);
    message.mutable_open()->set_device(number);
    message.mutable_open()->set_device_label(label);
    const auto session = server_->connect([] {});
    session->receive(message);
    proto::ServerReply reply;
    waitFor([&] { return session->take(reply) || !session->end().empty(); });
    return reply.has_welcome() ? reply.welcome() : proto::Welcome();
  };
  const proto::Welcome right = open(0, "right");
  EXPECT_EQ(right.device(), 1U);
  ASSERT_EQ(right.devices_size(), 2);
  EXPECT_EQ(right.devices(0).label(), "left");
  EXPECT_EQ(right.devices(1).label(), "right");
  EXPECT_EQ(right.devices(1).name(), "Force Dimension omega.3");
  EXPECT_EQ(open(1, "").device(), 1U);
  EXPECT_EQ(open(1, "left").device(), 0U);
  EXPECT_EQ(open(0, "middle").devices_size(), 0);
  const auto session = server_->connect([] {});
  proto::ClientMessage message;
  message.mutable_open()->set_protocol_version(1);
  message.mutable_open()->set_device_label("middle");
  session->receive(message);
  EXPECT_EQ(session->end(), "there is no device 'middle'; the server has 2: 0 (left), 1 (right)");
}

TEST_F(SeveralDevices, AreAllInTheMetricsAndInTheHealth) {
  start(false);
  const MonitorCallbacks monitor = makeTouchMonitor(server_->device(), server_.get());
  MetricsText healthy;
  waitFor([&] {
    healthy = MetricsText();
    monitor.metrics(healthy);
    const auto on = [&](const std::string& name) {
      return healthy.text().find("hl_safety_state{device=\"" + name + "\",state=\"on\"} 1\n") != std::string::npos;
    };
    return isOn(0) && isOn(1) && monitor.fault().empty() && on("left") && on("right");
  });
  for (const char* name : {"left", "right"}) {
    const std::string device = std::string("{device=\"") + name + "\",";
    EXPECT_NE(lineWith(healthy.text(), "hl_loop_steps_total" + device + "loop=\"servo\"} "), "");
    EXPECT_NE(lineWith(healthy.text(), std::string("hl_vibrations_total{device=\"") + name + "\"} "), "");
  }
  EXPECT_EQ(lineWith(healthy.text(), "hl_scene_primitives"), "hl_scene_primitives 0");
  const std::string& text = healthy.text();
  const std::string type = "# TYPE hl_loop_steps_total";
  EXPECT_EQ(text.find(type), text.rfind(type)) << "a family once, with the samples of all devices";
  bench_->arm(1).lost = true;
  waitFor([this] { return isInFault(1, FaultReason::kDeviceLost); });
  waitFor([&] {
    if (servo(0).safety == SafetyState::kFault) server_->device(0).live().rearm();
    return monitor.fault() ==
           "device 'right': the servo is in fault: the device does not answer: check its cable and power";
  });
  MetricsText lost;
  monitor.metrics(lost);
  EXPECT_NE(lost.text().find("hl_safety_state{device=\"right\",state=\"fault\"} 1\n"), std::string::npos);
  EXPECT_NE(lineWith(lost.text(), "hl_safety_state{device=\"left\",state=\"fault\"} "), "");
}

// In its own message a page finds each device by its name; what it sends is for the one that it names.
TEST_F(SeveralDevices, AreAllSentToPages) {
  start(false);
  ViewerFeedSettings settings;
  settings.others = server_->otherDevices();
  const FeedCallbacks feed = makeViewerFeed(server_->device(), "test", settings);
  proto::ServerMessage hello, state;
  ASSERT_TRUE(hello.ParseFromString(feed.hello()));
  ASSERT_EQ(hello.hello().devices_size(), 2);
  EXPECT_EQ(hello.hello().device().label(), "left");
  EXPECT_EQ(hello.hello().devices(1).label(), "right");
  EXPECT_FALSE(hello.hello().devices(1).simulated_hand());
  bench_->arm(1).lost = true;
  waitFor([this] { return isInFault(1, FaultReason::kDeviceLost); });
  ASSERT_TRUE(state.ParseFromString(feed.state()));
  ASSERT_EQ(state.state().others_size(), 1);
  EXPECT_EQ(state.state().others(0).label(), "right");
  EXPECT_EQ(state.state().others(0).safety(), proto::FAULT);
  EXPECT_EQ(state.state().others(0).fault(), "the device does not answer: check its cable and power");
  EXPECT_GT(state.state().others(0).proxy_radius(), 0);
  bench_->arm(1).lost = false;
  waitFor([this] { return isInFault(1, FaultReason::kDeviceReturned); });
  proto::ViewerMessage rearm;
  rearm.mutable_rearm();
  rearm.set_device(7);
  feed.receive(1, rearm.SerializeAsString());
  EXPECT_EQ(servo(1).safety, SafetyState::kFault);
  rearm.set_device(1);
  waitFor([&] {
    feed.receive(1, rearm.SerializeAsString());
    return servo(1).safety == SafetyState::kOn;
  });
}

TEST_F(SeveralDevices, OneThatIsLostLeavesTheOtherOn) {
  start(false);
  bench_->arm(0).lost = true;
  waitFor([this] { return isInFault(0, FaultReason::kDeviceLost); });
  const std::uint64_t steps = server_->device(1).servoTotals().steps;
  waitFor([&] { return server_->device(1).servoTotals().steps > steps + 200; });
  EXPECT_NE(servo(1).fault, FaultReason::kOtherDevice);
  EXPECT_NE(servo(1).fault, FaultReason::kDeviceLost);
  bench_->arm(0).lost = false;
  waitFor([this] { return isInFault(0, FaultReason::kDeviceReturned); });
  server_->device(0).live().rearm();
  waitFor([this] { return isOn(0) && isOn(1); });
}

TEST_F(SeveralDevices, OfJoinedFaultsOneStopsBothAndToArmOneIsToArmBoth) {
  start(true);
  for (const std::size_t lost : {0U, 1U}) {
    const std::size_t other = 1 - lost;
    bench_->arm(lost).lost = true;
    waitFor([&] { return isInFault(lost, FaultReason::kDeviceLost); });
    waitFor([&] { return isInFault(other, FaultReason::kOtherDevice); });
    EXPECT_EQ(servo(other).force_N, Vec3(Vec3::Zero()));
    EXPECT_LT(bench_->arm(other).force_D().norm(), 1e-12);
    // Nobody can arm the other while this one is away; the wish waits.
    server_->device(other).live().rearm();
    const std::uint64_t steps = server_->device(other).servoTotals().steps;
    waitFor([&] { return server_->device(other).servoTotals().steps > steps + 50; });
    EXPECT_TRUE(isInFault(other, FaultReason::kOtherDevice));
    bench_->arm(lost).lost = false;
    waitFor([&] { return servo(lost).fault != FaultReason::kDeviceLost; });
    server_->device(other).live().rearm();
    waitFor([this] { return isOn(0) && isOn(1); });
  }
}

TEST_F(SeveralDevices, OfJoinedFaultsBothArmAgainByThemselvesWhereThatIsWanted) {
  start(true, true);
  bench_->arm(1).lost = true;
  waitFor([this] { return isInFault(1, FaultReason::kDeviceLost) && isInFault(0, FaultReason::kOtherDevice); });
  bench_->arm(1).lost = false;
  waitFor([this] { return isOn(0) && isOn(1); });
}

TEST(SeveralDevicesOfAServer, AreOneToSixteenAndTheOneThatIsMissingIsNamed) {
  TouchServerSettings settings;
  settings.devices.clear();
  EXPECT_EQ(refusalOf(settings), "a server has 1 to 16 devices");
  settings.devices.assign(17, {"x", "sim"});
  EXPECT_EQ(refusalOf(settings), "a server has 1 to 16 devices");
  setenv("HL_HD_LIBRARY", "/nonexistent/libHD.so", 1);
  settings.devices = {{"left", "sim"}, {"right", "hd"}};
  const std::string why = refusalOf(settings);
  EXPECT_EQ(why.rfind("device 'right': ", 0), 0U) << why;
  EXPECT_NE(why.find("OpenHaptics"), std::string::npos) << why;
}

TEST(FaultGroup, AnotherOnesFaultIsSeenAndTheOwnIsNot) {
  FaultGroup group;
  EXPECT_FALSE(group.othersFail(0));
  group.set(0, true);
  EXPECT_FALSE(group.othersFail(0));
  EXPECT_TRUE(group.othersFail(1));
  group.set(1, true);
  group.set(0, false);
  EXPECT_TRUE(group.othersFail(0));
  EXPECT_FALSE(group.othersFail(1));
  group.set(1, false);
  group.set(1, false);
  for (std::uint32_t device : {0U, 1U, 15U}) EXPECT_FALSE(group.othersFail(device));
}

}  // namespace
}  // namespace hl::test::test_several_devices
