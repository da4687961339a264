// Hands as a bridge publishes them, and what they feel of what comes: with another program in the place of hl-ros.
#include "ros/ros_bridge.h"

#include <gtest/gtest.h>

#include <deque>
#include <mutex>

#include "base/clock.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_ros_bridge {
namespace {

/// What the test and its link share.
struct Wire {
  std::mutex mutex;  // of what follows
  std::vector<RosHandState> states;
  std::deque<HandCommand> commands;
  bool full = false, ended = false;
  int refusals = 0;  // of starting again

  std::vector<RosHandState> published() {
    const std::lock_guard lock(mutex);
    return states;
  }
  void say(const HandCommand& command) {
    const std::lock_guard lock(mutex);
    commands.push_back(command);
  }
  void set(bool& what) {
    const std::lock_guard lock(mutex);
    what = true;
  }
};

class FakeLink final : public RosLink {
 public:
  explicit FakeLink(Wire& wire) : wire_(wire) {}
  void wait(std::int64_t) override { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }
  bool send(const RosHandState& state) override {
    const std::lock_guard lock(wire_.mutex);
    if (!wire_.full) wire_.states.push_back(state);
    return !wire_.full;
  }
  std::optional<HandCommand> receive() override {
    const std::lock_guard lock(wire_.mutex);
    if (wire_.commands.empty()) return std::nullopt;
    const HandCommand command = wire_.commands.front();
    wire_.commands.pop_front();
    return command;
  }
  bool ended() const override {
    const std::lock_guard lock(wire_.mutex);
    return wire_.ended;
  }
  bool startAgain() override {
    const std::lock_guard lock(wire_.mutex);
    wire_.ended = wire_.refusals-- > 0;
    return !wire_.ended;
  }

 private:
  Wire& wire_;
};

TouchSettings quiet() {
  TouchSettings settings;
  settings.explore = false;
  return settings;
}

class RosBridgeTest : public ::testing::Test {
 protected:
  RosBridgeTest() {
    for (auto& session : sessions_) session.start();
    bridge_.start();
  }
  // Such as a person has said a moment ago.
  void say(std::uint32_t hand, RosInput input, const std::array<double, 3>& value, std::uint64_t own_frame = 1) {
    wire_.say({input, hand, own_frame, 0, monotonicNow_ns(), value});
  }
  // A busy machine may hold a servo up, which is a fault: then a person arms again.
  Vec3 forceOf(std::size_t hand) {
    const ServoView servo = test::servoOf(sessions_[hand]);
    if (servo.safety == SafetyState::kFault) sessions_[hand].live().rearm();
    return servo.force_N;
  }
  std::uint64_t count(CommandVerdict verdict) const {
    return bridge_.counts().verdicts[static_cast<std::size_t>(verdict)];
  }

  Wire wire_;
  std::mutex lines_mutex_;
  std::vector<std::string> lines_;
  const std::shared_ptr<const Snapshot> nothing_ = makeSnapshot(std::vector<Instance>{}, "nothing");
  std::array<TouchSession, 2> sessions_{TouchSession(nothing_, quiet()), TouchSession(nothing_, quiet())};
  RosBridge bridge_{std::make_unique<FakeLink>(wire_),
                    {&sessions_[0], &sessions_[1]},
                    250,
                    [this](const std::string& line) {
                      const std::lock_guard lock(lines_mutex_);
                      lines_.push_back(line);
                    },
                    TeleopOfHand{1, {2, 0.5, std::nullopt, 0.5}}};  // without a clutch
};

TEST_F(RosBridgeTest, PublishesBothHandsOverAndOverWithTheirTimes) {
  const std::int64_t begin_ns = std::chrono::system_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
  std::array<std::vector<RosHandState>, 2> of;
  test::waitFor([&] {
    of = {};
    for (const RosHandState& state : wire_.published()) of.at(state.hand).push_back(state);
    return of[0].size() >= 20 && of[1].size() >= 20;
  });
  for (const auto& states : of) {
    for (std::size_t i = 1; i < states.size(); ++i) EXPECT_GT(states[i].time_ns, states[i - 1].time_ns);
    // The clock of the system: within a minute of the one that the test has read.
    EXPECT_LT(std::abs(states[0].time_ns - begin_ns), 60'000'000'000);
    const Vec3 there(states.back().position[0], states.back().position[1], states.back().position[2]);
    EXPECT_TRUE(there.allFinite());
  }
  EXPECT_GE(bridge_.counts().states, 40u);
  EXPECT_TRUE(bridge_.counts().running);
}

TEST_F(RosBridgeTest, AForceIsFeltByItsHandAndPublishedAndEndsByItself) {
  test::waitFor([&] {
    say(1, RosInput::kServoCf, {0, 0, 1.25});
    return (forceOf(1) - Vec3(0, 0, 1.25)).norm() < 1e-9;
  });
  EXPECT_TRUE(forceOf(0).isZero(0));
  test::waitFor([&] {
    say(1, RosInput::kServoCf, {0, 0, 1.25});
    const RosHandState last = wire_.published().back();
    forceOf(1);
    return last.hand == 1 && std::abs(last.force[2] - 1.25) < 1e-9;
  });
  test::waitFor([&] { return forceOf(1).isZero(0); });
  test::waitFor([&] { return bridge_.counts().ends >= 1; });
  EXPECT_GE(bridge_.counts().received[0], 2u);
}

TEST_F(RosBridgeTest, ASetPointPullsToItsPlace) {
  const Vec3 place_D = test::servoOf(sessions_[0]).finger_D + Vec3(0.02, 0, 0);
  test::waitFor([&] {
    say(0, RosInput::kServoCp, {place_D.x(), place_D.y(), place_D.z()});
    return forceOf(0).x() > 0.5;
  });
  EXPECT_GE(bridge_.counts().received[1], 1u);
}

// Of the second hand alone, at the scale 2.
TEST_F(RosBridgeTest, AHandLeadsARobotByItsWay) {
  const auto farthest_m = [&] {
    double most_m = 0;
    for (const RosHandState& state : wire_.published()) {
      EXPECT_EQ(state.leads_robot, state.hand);
      most_m = std::max(most_m, std::abs(state.set_point[0]));
    }
    return most_m;
  };
  const Vec3 place_D = test::servoOf(sessions_[1]).finger_D + Vec3(0.02, 0, 0);
  test::waitFor([&] {
    say(1, RosInput::kServoCp, {place_D.x(), place_D.y(), place_D.z()});
    forceOf(1);
    return farthest_m() > 0.02;
  });
}

// At the force scale 1/2. Its energy is the tank's: nobody gives more.
TEST_F(RosBridgeTest, ARobotsForceIsFeltAndEndsByItself) {
  test::waitFor([&] {
    say(1, RosInput::kRemoteCf, {0, 2, 0});
    say(1, RosInput::kRemoteEnergy, {1, 0, 0});
    return forceOf(1).y() > 0.3 && bridge_.counts().teleop->port.energy.given_J > 0;
  });
  test::waitFor([&] { return forceOf(1).isZero(1e-3); });
  EXPECT_LE(bridge_.counts().teleop->port.energy.given_J,
            HL_TELEOP_TANK_J + bridge_.counts().teleop->port.energy.put_in_J);
  EXPECT_GE(bridge_.counts().received[static_cast<std::size_t>(RosInput::kRemoteCf)], 1u);
}

TEST_F(RosBridgeTest, AHandWithoutARobotTakesNoneOfItsTopics) {
  say(0, RosInput::kRemoteCf, {0, 2, 0});
  test::waitFor([&] { return count(CommandVerdict::kMalformed) == 1; });
  EXPECT_TRUE(forceOf(0).isZero(0));
}

TEST_F(RosBridgeTest, WhatCannotBeTrustedIsCountedAndNotFelt) {
  say(0, RosInput::kServoCf, {std::nan(""), 0, 0});
  say(0, RosInput::kServoCf, {3, 0, 0}, 0);
  say(0, RosInput::kMalformed, {3, 0, 0});
  say(7, RosInput::kServoCf, {3, 0, 0});
  say(0, static_cast<RosInput>(99), {3, 0, 0});
  wire_.say({RosInput::kServoCf, 0, 1, 60'000'000, monotonicNow_ns(), {3, 0, 0}});
  test::waitFor([&] { return count(CommandVerdict::kStale) == 1; });
  EXPECT_EQ(count(CommandVerdict::kNotANumber), 1u);
  EXPECT_EQ(count(CommandVerdict::kOtherFrame), 1u);
  EXPECT_EQ(count(CommandVerdict::kMalformed), 3u);
  EXPECT_EQ(count(CommandVerdict::kTaken), 0u);
  EXPECT_TRUE(forceOf(0).isZero(0));
  // Each reason once.
  const std::lock_guard lock(lines_mutex_);
  EXPECT_EQ(lines_.size(), 4u);
}

TEST_F(RosBridgeTest, StatesThatNobodyTakesAreLostAndCounted) {
  wire_.set(wire_.full);
  test::waitFor([&] { return bridge_.counts().states_lost > 10; });
}

TEST_F(RosBridgeTest, AProgramThatEndsLetsGoAndIsStartedAgain) {
  test::waitFor([&] {
    say(0, RosInput::kServoCf, {1, 0, 0});
    return forceOf(0).x() > 0;
  });
  wire_.refusals = 1;
  wire_.set(wire_.ended);
  test::waitFor([&] { return !bridge_.counts().running; });
  test::waitFor([&] { return forceOf(0).isZero(0); });
  test::waitFor([&] { return bridge_.counts().starts == 1; });
  test::waitFor([&] {
    say(0, RosInput::kServoCf, {1, 0, 0});
    return forceOf(0).x() > 0;
  });
  EXPECT_TRUE(bridge_.counts().running);
  const std::lock_guard lock(lines_mutex_);
  EXPECT_EQ(lines_, (std::vector<std::string>{"hl-ros has ended: hands are no topics of ROS 2 until it is there again",
                                              "hl-ros is there again"}));
}

TEST_F(RosBridgeTest, AStopDoesNotWaitForAProgramThatIsAway) {
  wire_.refusals = 1000;
  wire_.set(wire_.ended);
  test::waitFor([&] { return !bridge_.counts().running; });
  bridge_.stop();
  EXPECT_EQ(bridge_.counts().starts, 0u);
}

TEST(RosHands, AreCalledAsTheirDevices) {
  EXPECT_EQ(rosHands("lab", {""}), std::vector<std::string>{"lab/hand"});
  EXPECT_EQ(rosHands("lab", {"left", "right"}), (std::vector<std::string>{"lab/left", "lab/right"}));
  EXPECT_EQ(rosHands("lab", {"a-b", "a_b", "a--b", "c__d-"}),
            (std::vector<std::string>{"lab/a_b", "lab/a_b_2", "lab/a_b_3", "lab/c_d_"}));
}

}  // namespace
}  // namespace hl::test_ros_bridge
