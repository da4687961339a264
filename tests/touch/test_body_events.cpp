// What is reported of bodies: impacts by the impulse that theory says, sleep, and that they wake.
#include "touch/body_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "block_scenes.h"
#include "bodies/test_worlds.h"
#include "device/open_device.h"
#include "guard/realtime_guard.h"
#include "proxy/effect_scenes.h"
#include "touch/ticker.h"

namespace hl::test_body_events {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;
constexpr double kMass_kg = 0.1, kHalf_m = 0.02, kGravity_m_s2 = 9.81;

// A block above a floor, and a finger far away.
class Falling {
 public:
  Falling(double height_m, double restitution) {
    const Box room{Vec3::Constant(-1), Vec3::Constant(1)};
    BodySpec floor;
    floor.fixed = true;
    floor.surface.restitution = restitution;
    Instance ground = test::instanceOf(test::floorModel(), 1);
    ground.body = makeRigidBody("floor", floor, {}, {}, room);
    Instance block = test::instanceOf(test::boxModel(Vec3::Constant(kHalf_m)), 2);
    BodySpec spec;
    spec.mass_kg = kMass_kg;
    spec.shape = BodyShape::kBox;
    spec.surface.restitution = restitution;
    const Pose start{Mat3::Identity(), Vec3(0, kHalf_m + height_m, 0)};
    setBody(block, makeRigidBody("block", spec, start, block.shape->bounds, room));
    block.session = 5;
    block.object = 6;
    block.name = 7;
    instances_ = {ground, block};
    slot_.emplace(scene(1));
    loop_.emplace(*slot_, ProxySettings{});
    step();
  }

  void pass(double seconds) {
    for (double t = 0; t < seconds; t += 1e-9 * kStep_ns) step();
  }
  std::vector<BodyEvent> run(double seconds) {
    pass(seconds);
    std::vector<BodyEvent> reported;
    for (BodyEvent event; loop_->popEvent(event);) reported.push_back(event);
    return reported;
  }
  void act(BodyCommand command) {
    command.key = 2;
    BodyCommands commands;
    commands.push(command);
    loop_->act(commands);
  }
  void showAgain() { slot_->publish(scene(2)); }

 private:
  void step() { loop_->step(now_ns_ += kStep_ns, Vec3(0.5, 0.5, 0.5), {}, {}); }
  std::shared_ptr<const Snapshot> scene(std::uint64_t number) const {
    return makeSnapshot(instances_, {}, number, 0, {Vec3(0, -kGravity_m_s2, 0), {}});
  }

  std::vector<Instance> instances_;
  std::optional<SnapshotSlot> slot_;
  std::optional<ProxyLoop> loop_;
  std::int64_t now_ns_ = 0;
};

// The step before and the step after may bear the weight; the fall's speed is that of whole steps.
void expectImpulse(const BodyEvent& event, double momentum_N_s) {
  const double weight_N_s = kMass_kg * kGravity_m_s2 * 1e-9 * kStep_ns;
  EXPECT_NEAR(event.impulse_N_s, momentum_N_s + 0.5 * weight_N_s, 2 * weight_N_s);
}

TEST(BodyEvents, AFallIsOneImpactOfItsMomentumAndThenSleep) {
  Falling falling(0.05, 0);
  const std::vector<BodyEvent> reported = falling.run(2);
  ASSERT_EQ(reported.size(), 2U);
  const double speed_m_s = std::sqrt(2 * kGravity_m_s2 * 0.05);
  EXPECT_EQ(reported[0].kind, BodyEventKind::kImpact);
  expectImpulse(reported[0], kMass_kg * speed_m_s);
  EXPECT_NEAR(1e-9 * static_cast<double>(reported[0].time_ns), speed_m_s / kGravity_m_s2, 0.003);
  EXPECT_NEAR(reported[0].position_W.y(), kHalf_m, 1e-3);
  EXPECT_EQ(reported[0].object.session, 5U);
  EXPECT_EQ(reported[0].object.object, 6U);
  EXPECT_EQ(reported[0].object.name, 7U);
  EXPECT_EQ(reported[1].kind, BodyEventKind::kSleep);
  EXPECT_EQ(reported[1].object.object, 6U);
}

TEST(BodyEvents, ABounceGivesMoreByItsRestitution) {
  Falling falling(0.05, 0.5);
  const std::vector<BodyEvent> reported = falling.run(0.15);
  ASSERT_EQ(reported.size(), 1U);
  const double momentum_N_s = 1.5 * kMass_kg * std::sqrt(2 * kGravity_m_s2 * 0.05);
  expectImpulse(reported[0], momentum_N_s);
}

TEST(BodyEvents, WhatAClientDoesWakesAndIsNoImpact) {
  Falling falling(0, 0);
  std::vector<BodyEvent> reported = falling.run(1);
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(reported[0].kind, BodyEventKind::kSleep);
  falling.showAgain();
  EXPECT_TRUE(falling.run(0.1).empty()) << "it sleeps on in the next scene";
  BodyCommand command;
  command.velocity_m_s = Vec3(0, 1, 0);
  falling.act(command);
  reported = falling.run(0.15);
  ASSERT_EQ(reported.size(), 1U) << "it flies";
  EXPECT_EQ(reported[0].kind, BodyEventKind::kWake);
  {
    const RealtimeGuard guard;
    falling.pass(0.15);
  }
  reported = falling.run(0);
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(reported[0].kind, BodyEventKind::kImpact);
  expectImpulse(reported[0], kMass_kg * 1);
}

// While the device does not answer there are no steps; then all is done, four in a step.
TEST(BodyEvents, WhatClientsDoWhileTheDeviceIsGoneIsDoneWhenItIsBack) {
  constexpr int kCommands = 10;
  const auto scene = test::sceneOfBlocks({test::Block{}}, 0, 0);
  const auto device = openDevice("sim");
  SnapshotSlot scenes(scene);
  LiveSettings live({}, device->info(), scene->bounds);
  LoopExchange exchange;
  TouchViews views;
  NoSink sink;
  Ticker ticker(scenes, live, exchange, views, sink, kStep_ns, false);
  BodyCommand push;
  push.key = 2;
  push.impulse_N_s = Vec3(0, 1e-3, 0);
  for (int i = 0; i < kCommands; ++i) {
    EXPECT_TRUE(live.actOnBody(push));
    ticker.follow();
    ticker.loop().skip();
  }
  for (int i = 1; i <= 5; ++i) ticker.loop().step(i * kStep_ns, Vec3(0.5, 0.5, 0.5), ticker.follow(), {});
  const BodyWorld& world = *ticker.loop().bodies();
  const double momentum_N_s = world.world().bodies[0].mass.mass_kg * world.state().bodies[0].velocity.y();
  EXPECT_NEAR(momentum_N_s, kCommands * 1e-3, 1e-12);
}

}  // namespace
}  // namespace hl::test_body_events
