// The hands of several devices at one world of bodies, whose loop the tests turn.
#include "touch/hand_group.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "block_scenes.h"
#include "device/open_device.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "plain_servo.h"
#include "touch/touch_step.h"

namespace hl::test_hand_group {
namespace {

constexpr double kRadius_m = 0.001, kStiffness_N_m = 1000, kFriction = 0.5;
constexpr std::int64_t kMs = 1'000'000;

TouchSettings settingsOfHand() {
  TouchSettings settings;
  settings.world_per_device = 1;
  settings.stiffness_N_m = kStiffness_N_m;
  settings.ledger = LedgerMode::kReport;
  return settings;
}

// A device that makes force, without its servo.
class Hand {
 public:
  Hand(const std::shared_ptr<const Snapshot>& scene, HandGroup& group)
      : scenes_(scene, SnapshotSlot::Bodies::kElsewhere),
        live_(settingsOfHand(), device_->info(), scene->bounds),
        ticker_(scenes_, live_, exchange_, views_, sink_, kMs, true) {
    live_.setWorkspace({});
    live_.setRadius(kRadius_m);
    MaterialOverride rough;
    rough.static_friction = rough.dynamic_friction = kFriction;
    live_.setSurfaces(rough);
    exchange_.makes_force = true;
    group.join({*device_, live_, exchange_, ticker_, views_, sink_, {}});
  }
  void moveTo(const Vec3& finger) { exchange_.finger_D.write(finger_ = finger); }
  // What its servo asks before each tick of its own.
  bool servoTicks() { return ticker_.isTurnOf(Turn::kServo); }
  void show(const std::shared_ptr<const Snapshot>& scene) {
    scenes_.publish(SnapshotSlot::prepare(scene, SnapshotSlot::Bodies::kElsewhere));
  }
  // Of the last tick.
  Vec3 force_N() {
    const ServoTarget& target = held().target;
    return target.valid ? Vec3(kStiffness_N_m * target.stiffness * (target.proxy_D - finger_)) : Vec3::Zero();
  }
  const HeldContacts& held() {
    exchange_.ticks.read(tick_);
    return tick_.held;
  }
  const Vec3& finger() const { return finger_; }
  const Vec3& proxy() { return ticker_.loop().state().position; }
  std::uint64_t ticks() const { return ticker_.ticks(); }
  const BodyWorld* bodies() { return ticker_.loop().bodies(); }
  void stopForce() { exchange_.makes_force = false; }

 private:
  const std::unique_ptr<Device> device_ = openDevice("sim");
  SnapshotSlot scenes_;
  LiveSettings live_;
  LoopExchange exchange_;
  TouchViews views_;
  NoSink sink_;
  Ticker ticker_;
  TickMessage tick_;
  Vec3 finger_ = Vec3::Zero();
};

// Hands at blocks; time goes by steps of 1 ms.
class Hands {
 public:
  Hands(std::size_t hands, const std::vector<test::Block>& blocks, double friction, double gravity_m_s2)
      : scene_(test::sceneOfBlocks(blocks, friction, gravity_m_s2)), group_(scene_, 1000) {
    for (std::size_t i = 0; i < hands; ++i) hands_.push_back(std::make_unique<Hand>(scene_, group_));
    for (const auto& hand : hands_) EXPECT_FALSE(hand->servoTicks()) << "of a scene with bodies";
  }
  Hand& operator[](std::size_t i) { return *hands_[i]; }
  void tick() {
    group_.tick(time_ns_ += kMs);
    for (const auto& hand : hands_) given_N_s_ += 1e-3 * hand->force_N();
  }
  ShownBody body(std::size_t i = 0) const { return scene_->instances[i + 1].body->poses->shown(); }
  // N s: on the hands, on the bodies, and owed to them.
  Vec3 imbalance() {
    const BodyWorld& world = *hands_[0]->bodies();
    Vec3 sum = given_N_s_ + world.owed_N_s();
    for (std::size_t i = 0; i < world.world().bodies.size(); ++i)
      sum += world.world().bodies[i].mass.mass_kg * world.state().bodies[i].velocity;
    return sum;
  }
  HandGroup& group() { return group_; }

 private:
  std::shared_ptr<const Snapshot> scene_;
  HandGroup group_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::int64_t time_ns_ = 0;
  Vec3 given_N_s_ = Vec3::Zero();
};

// R19 with the proxies of two devices: they press on the faces of a block from both sides, then go up.
class Lift {
 public:
  explicit Lift(double squeeze_N)
      : hands_(2, {{kMass_kg, Vec3::Constant(kHalf_m), Vec3(0, kHalf_m, 0)}}, kFriction, 9.81) {
    const double in_m = squeeze_N / kStiffness_N_m;
    for (double t = 0; t < 0.5; t += 1e-3)
      reach(kHalf_m + kRadius_m + (t < 0.2 ? 0.005 - 0.025 * t : 0) - in_m, kHalf_m);
    for (double t = 0; t < 1; t += 1e-3) reach(kHalf_m + kRadius_m - in_m, kHalf_m + 0.03 * t);
    for (double t = 0; t < 0.5; t += 1e-3) reach(kHalf_m + kRadius_m - in_m, kHalf_m + 0.03);
  }
  double height_m() const { return hands_.body().pose.origin.y() - kHalf_m; }
  Vec3 force_N() { return hands_[0].force_N() + hands_[1].force_N(); }

  static constexpr double kMass_kg = 0.1, kHalf_m = 0.02;

 private:
  void reach(double from_middle_m, double height_m) {
    for (std::size_t i = 0; i < 2; ++i) hands_[i].moveTo(Vec3(i == 0 ? -from_middle_m : from_middle_m, height_m, 0));
    hands_.tick();
  }
  Hands hands_;
};

TEST(HandGroup, R19TwoDevicesLiftABlockBetweenThem) {
  Lift lift(3);
  EXPECT_NEAR(lift.height_m(), 0.03 - 0.5 * Lift::kMass_kg * 9.81 / kStiffness_N_m, 1e-4);
  // It still swings a little on the springs, which have no damping.
  EXPECT_LT((lift.force_N() - Vec3(0, -Lift::kMass_kg * 9.81, 0)).norm(), 0.01);
}

TEST(HandGroup, R19ABlockSlipsFromHandsThatPressTooLittle) {
  EXPECT_NEAR(Lift(0.9 * Lift::kMass_kg * 9.81).height_m(), 0, 1e-6);
}

// A simulated device with a hand that holds it, and its servo, which has the tick of the period before.
class Gripping {
 public:
  Gripping(Hand& hand, const Vec3& begin) : hand_(hand) {
    settings_.ledger = LedgerMode::kTank;
    arm(step_.servo());
    device_.place(begin, Vec3::Zero());
  }
  void step(std::int64_t time_ns, const Vec3& goal) {
    device_.setHandGoal(goal);
    const DeviceSample sample = device_.read(time_ns);
    const ServoOutput out = step_.late(hand_.held(), settings_, sample);
    EXPECT_NE(out.safety, SafetyState::kFault) << faultText(out.fault);
    device_.write(out.force_N);
    hand_.moveTo(sample.position);
  }
  double speed_m_s() const { return device_.trueVelocity_D().norm(); }

 private:
  static SimulatedDeviceSettings gripped() {
    SimulatedDeviceSettings settings;
    settings.model = premium10();
    settings.step_s = 100e-6;
    return settings;
  }
  Hand& hand_;
  SimulatedDevice device_{gripped()};
  ServoSettings settings_ = test::plainServo(kStiffness_N_m);
  TouchStep step_;
};

// Two devices squeeze a block, from a feather to a brick, and go up with it, by the forces of their real servos.
TEST(HandGroup, DevicesHoldABlockOfAnyMassAtRest) {
  for (const double mass_kg : {1e-6, 1e-4, 0.01, 0.1}) {
    constexpr double kHalf_m = 0.02, kUp_m = 0.03;
    Hands hands(2, {{mass_kg, Vec3::Constant(kHalf_m), Vec3(0, kHalf_m, 0)}}, kFriction, 9.81);
    std::deque<Gripping> devices;
    for (const std::size_t i : {0U, 1U}) devices.emplace_back(hands[i], Vec3(i == 0 ? -0.04 : 0.04, kHalf_m, 0));
    for (int ms = 1; ms <= 3000; ++ms) {
      const double in = std::min(1.0, ms / 500.0), up = std::clamp((ms - 700) / 800.0, 0.0, 1.0);
      for (const std::size_t i : {0U, 1U})
        devices[i].step(ms * kMs, Vec3((i == 0 ? -1 : 1) * (0.04 - 0.03 * in), kHalf_m + kUp_m * up, 0));
      hands.tick();
    }
    EXPECT_GT(hands.body().pose.origin.y(), kHalf_m + 0.8 * kUp_m) << mass_kg;
    EXPECT_LT(hands.body().velocity_m_s.norm(), 1e-3) << mass_kg;
    for (const Gripping& device : devices) EXPECT_LT(device.speed_m_s(), 1e-3) << mass_kg;
  }
}

// Devices of 100 g, which persons move to and fro between two blocks in the air.
TEST(HandGroup, ActionIsReactionToRounding) {
  constexpr double kDevice_kg = 0.1;
  Hands hands(3, {{0.1, Vec3::Constant(0.02), Vec3(0, 0.5, 0)}, {0.002, Vec3(0.01, 0.02, 0.01), Vec3(0.05, 0.5, 0)}},
              kFriction, 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vec3> fingers{{-0.04, 0.5, 0}, {0.09, 0.5, 0}, {0.025, 0.55, 0}}, velocities(3, Vec3::Zero());
  double pushed_N_s = 0;
  for (int step = 0; step < 5000; ++step) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 by_person_N = 3 * Vec3(any(random), any(random), any(random)) + 5 * (Vec3(0.025, 0.5, 0) - fingers[i]);
      velocities[i] = 0.99 * velocities[i] + 1e-3 / kDevice_kg * (by_person_N + hands[i].force_N());
      fingers[i] += 1e-3 * velocities[i];
      hands[i].moveTo(fingers[i]);
    }
    hands.tick();
    ASSERT_LT(hands.imbalance().norm(), 1e-12) << step;
    for (std::size_t i = 0; i < 3; ++i) pushed_N_s += 1e-3 * hands[i].force_N().norm();
  }
  EXPECT_GT(pushed_N_s, 0.1) << "nothing was touched";
}

TEST(HandGroup, AHandWithoutForceIsNotThere) {
  Hands hands(2, {{}}, 0.4, 9.81);
  hands[1].stopForce();
  for (int step = 0; step < 300; ++step) {
    hands[0].moveTo(Vec3(0.2, 0.02, 0));
    hands[1].moveTo(Vec3(-0.025 + 1e-4 * step, 0.02, 0));
    hands.tick();
  }
  EXPECT_LT((hands.body().pose.origin - Vec3(0, 0.02, 0)).norm(), 1e-6);
}

TEST(HandGroup, AStepTakesNoMemory) {
  Hands hands(2, {{}, {0.1, Vec3::Constant(0.02), Vec3(0.05, 0.02, 0)}}, 0.4, 9.81);
  const auto push = [&](int step) {
    hands[0].moveTo(Vec3(-0.03 + 1e-5 * step, 0.02, 0));
    hands[1].moveTo(Vec3(0.08 - 1e-5 * step, 0.02, 0));
    hands.tick();
  };
  for (int step = 0; step < 200; ++step) push(step);
  const RealtimeGuard guard;
  for (int step = 200; step < 2000; ++step) push(step);
}

TEST(HandGroup, TheServoTicksWhereNothingMoves) {
  const auto still = test::sceneOfBlocks({}, 0.4, 9.81, 1), moving = test::sceneOfBlocks({{}}, 0.4, 9.81, 2);
  HandGroup group(still, 1000);
  Hand hand(still, group);
  EXPECT_TRUE(hand.servoTicks());
  group.tick(kMs);
  EXPECT_EQ(hand.ticks(), 0U);
  hand.show(moving);
  group.publish(SnapshotSlot::prepare(moving));
  group.tick(2 * kMs);
  EXPECT_EQ(hand.ticks(), 0U) << "it is the servo's turn still";
  EXPECT_FALSE(hand.servoTicks());
  group.tick(3 * kMs);
  EXPECT_EQ(hand.ticks(), 1U);
  const auto again = test::sceneOfBlocks({}, 0.4, 9.81, 3);
  hand.show(again);
  group.publish(SnapshotSlot::prepare(again));
  EXPECT_FALSE(hand.servoTicks());
  group.tick(4 * kMs);
  EXPECT_TRUE(hand.servoTicks());
  EXPECT_EQ(hand.ticks(), 1U);
}

TEST(HandGroup, TheWorldGoesOnWithOneHandAndRestsWithoutAny) {
  const auto scene = test::sceneOfBlocks({{0.1, Vec3::Constant(0.02), Vec3(0, 0.5, 0)}}, 0.4, 10);
  HandGroup group(scene, 1000);
  Hand stuck(scene, group), other(scene, group);  // a servo that never gives its turn away
  const auto height_m = [&] { return scene->instances[1].body->poses->shown().pose.origin.y(); };
  for (int step = 0; step <= 100; ++step) group.tick(kMs * (1 + step));
  EXPECT_EQ(height_m(), 0.5);
  EXPECT_FALSE(other.servoTicks());
  for (int step = 0; step <= 100; ++step) group.tick(kMs * (102 + step));
  EXPECT_NEAR(height_m(), 0.45, 1e-3);
  EXPECT_EQ(stuck.ticks(), 0U);
}

}  // namespace
}  // namespace hl::test_hand_group
