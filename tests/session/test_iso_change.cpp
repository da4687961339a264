// Another iso value for a surface of the server's own scene, while the hand touches it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "phantom.h"
#include "scene/iso_shape.h"
#include "session/touch_server.h"
#include "take_replies.h"

namespace hl::test_iso_change {
namespace {

class IsoChangeTest : public testing::Test {
 protected:
  IsoChangeTest() : server_(makeSnapshot(makePhantom(61)), settings()), session_(server_.connect([] {})) {
    server_.start();
    proto::ClientMessage open;
    open.mutable_open()->set_protocol_version(1);
    session_->receive(open);
  }

  static TouchServerSettings settings() {
    TouchServerSettings settings;
    settings.touch.explore = false;
    settings.version = "test";
    return settings;
  }
  void send(std::uint64_t surface, double value, std::optional<bool> below = {}) {
    proto::ClientMessage message;
    if (below) message.mutable_iso()->set_below(*below);
    message.mutable_iso()->set_surface(surface);
    message.mutable_iso()->set_value(value);
    session_->receive(message);
  }
  bool until(const std::function<bool()>& reached) {
    return test::takeUntil(
        *session_, [this](const proto::ServerReply& reply) { refusal_ = reply.refusal().text() + refusal_; }, reached);
  }
  std::shared_ptr<const Snapshot> shown() { return server_.device().snapshot(); }
  bool shows(double value) { return isoSurfaceOf(shown()->instances[0])->iso().value == value; }
  std::string refusalOf(std::uint64_t surface, double value) {
    refusal_.clear();
    send(surface, value);
    EXPECT_TRUE(until([this] { return !refusal_.empty(); }));
    return refusal_;
  }

  TouchServer server_;
  std::unique_ptr<ClientSession> session_;
  std::string refusal_;
};

TEST_F(IsoChangeTest, IsTheSameObjectAndNothingElseChanges) {
  const auto before = shown();
  const Workspace workspace = server_.device().live().workspace();
  send(1, -900);
  ASSERT_TRUE(until([this] { return shows(-900); }));
  const auto after = shown();
  ASSERT_EQ(after->instances.size(), 2U);
  EXPECT_EQ(after->instances[0].key, before->instances[0].key);
  EXPECT_EQ(after->instances[0].surfaces, before->instances[0].surfaces);
  EXPECT_EQ(after->instances[0].replaced_in, after->number);
  EXPECT_EQ(after->instances[1].shape, before->instances[1].shape);
  EXPECT_EQ(after->instances[1].replaced_in, 0U);
  EXPECT_EQ(after->name, before->name);
  EXPECT_EQ(after->blend_ns, kAbruptBlend_ns);
  EXPECT_EQ(server_.device().live().workspace().world_per_device, workspace.world_per_device);
}

// What its matter says at the new value is in its material; what else the material says stays.
TEST(IsoChange, FollowsTheMatterOfItsVolume) {
  SceneModel phantom = makePhantom(41);
  const auto& iso = dynamic_cast<const IsoSurface&>(*phantom.surfaces[0].source);
  const auto matter = std::make_shared<const MatterTable>(
      std::vector<MatterRow>{{.value = -1000, .stiffness = 0}, {.value = 1000, .stiffness = 1}});
  phantom.surfaces[0].source = std::make_shared<const IsoSurface>(iso.volume(), iso.frame(), iso.iso(), matter);
  phantom.surfaces[0].material.static_friction = 0.25;
  Instance instance = makeSnapshot(phantom)->instances[0];
  EXPECT_DOUBLE_EQ(instance.surfaces->materials[0].stiffness, 0.26);
  for (const double value : {-900.0, 370.0, 2000.0}) {
    setIso(instance, {value});
    EXPECT_DOUBLE_EQ(instance.surfaces->materials[0].stiffness, std::min(1.0, (value + 1000) / 2000));
    EXPECT_EQ(instance.surfaces->materials[0].static_friction, 0.25);
    EXPECT_EQ(isoSurfaceOf(instance)->matter(), matter);
  }
}

TEST_F(IsoChangeTest, TheMatterStaysOnItsSideUntilAnotherIsSaid) {
  const auto side = [&] { return isoSurfaceOf(shown()->instances[0])->iso().solid; };
  send(1, -700, true);
  ASSERT_TRUE(until([this] { return shows(-700); }));
  EXPECT_EQ(side(), SolidSide::kBelow);
  send(1, -600);
  ASSERT_TRUE(until([this] { return shows(-600); }));
  EXPECT_EQ(side(), SolidSide::kBelow);
  send(1, -500, false);
  send(1, -400);  // before or after the loops have taken the one before: both count
  ASSERT_TRUE(until([this] { return shows(-400); }));
  EXPECT_EQ(side(), SolidSide::kAbove);
}

TEST_F(IsoChangeTest, WhatCannotBeIsRefusedWithWhatThereIs) {
  const auto before = shown();
  EXPECT_EQ(refusalOf(9, 0), "iso: there is no surface 9; those of volumes, with their values, are 1 (-480), 2 (370)");
  EXPECT_EQ(refusalOf(0, 0), "iso: say which surface; those of volumes, with their values, are 1 (-480), 2 (370)");
  EXPECT_EQ(refusalOf(1, std::numeric_limits<double>::quiet_NaN()), "iso: the value must be a finite number");
  EXPECT_EQ(refusalOf(1, std::numeric_limits<double>::infinity()), "iso: the value must be a finite number");
  EXPECT_EQ(shown(), before);
  send(1, 1e308);
  ASSERT_TRUE(until([this] { return shows(1e308); }));
  EXPECT_EQ(refusalOf(9, 0),
            "iso: there is no surface 9; those of volumes, with their values, are 1 (1e+308), 2 (370)");
}

TEST(IsoChange, ASceneWithoutVolumesRefusesIt) { EXPECT_THROW(checkIsoChange(*makeSnapshot(Model{}), 0, {}), Error); }

TEST_F(IsoChangeTest, TheForceStaysBoundedWhileTheValueSweeps) {
  TouchSession& device = server_.device();
  device.hand().setGoal({0, 0.04, 0});
  const double most_N = device.deviceInfo().force_max_N;
  for (const double value : {-480.0, -900.0, -200.0, 300.0, -900.0, 300.0, -480.0}) {
    send(1, value);
    ASSERT_TRUE(until([&] { return shows(value); }));
    const std::uint64_t from = device.moments().pushed();
    ASSERT_TRUE(until([&] { return device.moments().pushed() > from + 200; }));
    ServoView servo;
    ProxyView proxy;
    device.views(servo, proxy);
    EXPECT_LE(servo.force_N.norm(), most_N * (1 + 1e-9));
    EXPECT_NE(servo.safety, SafetyState::kFault);
  }
}

}  // namespace
}  // namespace hl::test_iso_change
