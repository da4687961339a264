// hl-ros on the wire, as Debian's Fast DDS hears it and speaks to it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "dds/fast_peer.h"
#include "dds/payloads.h"
#include "ros/ros_process.h"
#include "wait_for.h"

namespace hl::test_ros_wire {
namespace {

using test::FastPeer;
using test::Payload;
using test::Reliability;

// Of its own for each test: tests run beside each other. Above 101 ports are among those that others are given.
std::uint32_t ownDomain() { return 1 + static_cast<std::uint32_t>(getpid()) % 100; }
// Two tests may have one domain; their topics have names of their own.
std::string ownHand() { return "t" + std::to_string(getpid()) + "/hand"; }

RosTask taskOf(const std::string& hand) { return {HL_VERSION, ownDomain(), {hand}}; }

// 1 700 000 000.123456789 s after 1970, and numbers that no other part of the state has.
RosHandState state() {
  RosHandState state;
  state.buttons = 0b101;
  state.time_ns = 1'700'000'000'123'456'789;
  state.position = {1, -2, 0.5};
  state.orientation = {0, 0, 1, 0};
  state.velocity = {0.25, 4, -8};
  state.angular_velocity = {-1, 0.5, 1};
  state.has_gripper = 1;
  state.gripper_rad = 0.25;
  state.gripper_N = 4;
  state.force = {3, 0.125, -1};
  state.leads_robot = 1;
  state.set_point = {4, 0.5, 3};
  state.set_point_velocity = {-1, 0.125, -2};
  state.given_up_J = 0.25;
  return state;
}

// Sends the state until it is heard: nothing is sent again, and what is sent before both know of each other is lost.
Payload heard(RosProcess& ros, test::FastReader& reader) {
  std::optional<Payload> payload;
  test::waitFor([&] {
    ros.send(state());
    payload = reader.take();
    return payload.has_value();
  });
  return *payload;
}

void append(Payload& payload, std::initializer_list<int> bytes) {
  for (const int byte : bytes) payload.push_back(static_cast<std::uint8_t>(byte));
}

// Time: 1 700 000 000 = 0x6553f100 and 123 456 789 = 0x075bcd15. The frame "t/hand/base" has 11 letters and a 0; the
// next number is a double, at 8 + 4 + 12 = 24 behind the encapsulation.
Payload goldenHeader() {
  Payload header{0, 1, 0, 0};
  append(header, {0x00, 0xf1, 0x53, 0x65, 0x15, 0xcd, 0x5b, 0x07});
  append(header, {12, 0, 0, 0, 't', '/', 'h', 'a', 'n', 'd', '/', 'b', 'a', 's', 'e', 0});
  return header;
}
// Doubles of IEEE 754 whose last six bytes are 0: sign and exponent, and the first four bits of the fraction.
void appendDoubles(Payload& payload, std::initializer_list<int> first_two_bytes) {
  for (const int bytes : first_two_bytes) append(payload, {0, 0, 0, 0, 0, 0, bytes & 0xff, bytes >> 8});
}

constexpr int kOne = 0x3ff0, kMinusTwo = 0xc000, kHalf = 0x3fe0, kQuarter = 0x3fd0, kFour = 0x4010,
              kMinusEight = 0xc020, kThree = 0x4008, kEighth = 0x3fc0, kMinusOne = 0xbff0;

class GoldenBytes : public ::testing::Test {
 protected:
  Payload wire(const char* topic, const char* type) {
    const auto reader = peer_.reader(ddsTopic("t/hand", topic), type, Reliability::kBestEffort);
    return heard(ros_, *reader);
  }

 private:
  RosProcess ros_{taskOf("t/hand")};
  FastPeer peer_{ownDomain()};
};

TEST_F(GoldenBytes, OfAPose) {
  Payload golden = goldenHeader();
  appendDoubles(golden, {kOne, kMinusTwo, kHalf, 0, 0, kOne, 0});
  EXPECT_EQ(wire("measured_cp", test::kPoseType), golden);
}

TEST_F(GoldenBytes, OfATwist) {
  Payload golden = goldenHeader();
  appendDoubles(golden, {kQuarter, kFour, kMinusEight, kMinusOne, kHalf, kOne});
  EXPECT_EQ(wire("measured_cv", test::kTwistType), golden);
}

TEST_F(GoldenBytes, OfAWrench) {
  Payload golden = goldenHeader();
  appendDoubles(golden, {kThree, kEighth, kMinusOne, 0, 0, 0});
  EXPECT_EQ(wire("measured_cf", test::kWrenchType), golden);
}

// No axes, and eight buttons, of which the first and the third are down.
TEST_F(GoldenBytes, OfAJoy) {
  Payload golden = goldenHeader();
  append(golden, {0, 0, 0, 0, 8, 0, 0, 0});
  for (const int down : {1, 0, 1, 0, 0, 0, 0, 0}) append(golden, {down, 0, 0, 0});
  EXPECT_EQ(wire("buttons", test::kJoyType), golden);
}

// One name of 7 letters and a 0, one position, no velocity, one effort. Behind the header, at 24: a sequence of 1, text
// of 8; at 40 a sequence of 1, and its double at 48; sequences of 0 and 1 at 56 and 60, and the double at 64.
TEST_F(GoldenBytes, OfAGripper) {
  Payload golden = goldenHeader();
  append(golden, {1, 0, 0, 0, 8, 0, 0, 0, 'g', 'r', 'i', 'p', 'p', 'e', 'r', 0});
  append(golden, {1, 0, 0, 0, 0, 0, 0, 0});
  appendDoubles(golden, {kQuarter});
  append(golden, {0, 0, 0, 0, 1, 0, 0, 0});
  appendDoubles(golden, {kFour});
  EXPECT_EQ(wire("gripper/measured_js", test::kJointType), golden);
}

TEST_F(GoldenBytes, OfWhatLeadsARobot) {
  Payload place = goldenHeader(), velocity = goldenHeader(), energy{0, 1, 0, 0};
  appendDoubles(place, {kFour, kHalf, kThree, 0, 0, 0, kOne});
  EXPECT_EQ(wire("teleop/setpoint_cp", test::kPoseType), place);
  appendDoubles(velocity, {kMinusOne, kEighth, kMinusTwo, 0, 0, 0});
  EXPECT_EQ(wire("teleop/setpoint_cv", test::kTwistType), velocity);
  appendDoubles(energy, {kQuarter});
  EXPECT_EQ(wire("teleop/energy_in", test::kNumberType), energy);
}

// What has come of the samples that the writer repeats: the next one of this topic, as others may still be under way.
HandCommand received(RosProcess& ros, test::FastWriter& writer, const Payload& payload,
                     RosInput input = RosInput::kServoCf) {
  std::optional<HandCommand> command;
  test::waitFor([&] {
    writer.write(payload);
    command = ros.receive();
    return command && command->input == input;
  });
  return *command;
}

TEST(RosWire, TakesForcesAndPlacesOfReliableAndOfBestEffortWriters) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain());
  for (const Reliability reliability : {Reliability::kReliable, Reliability::kBestEffort}) {
    const auto force = peer.writer(ddsTopic(hand, "servo_cf"), test::kWrenchType, reliability);
    const HandCommand wrench = received(ros, *force, test::wrenchOf(rosFrame(hand), {1, 2, 3}));
    EXPECT_EQ(wrench.hand, 0u);
    EXPECT_EQ(wrench.own_frame, 1u);
    EXPECT_EQ(wrench.value, (std::array<double, 3>{1, 2, 3}));
    const auto place = peer.writer(ddsTopic(hand, "servo_cp"), test::kPoseType, reliability);
    const HandCommand pose = received(ros, *place, test::poseOf("", {-1, 0.5, 4}), RosInput::kServoCp);
    EXPECT_EQ(pose.own_frame, 1u);
    EXPECT_EQ(pose.value, (std::array<double, 3>{-1, 0.5, 4}));
  }
}

// Their topics are there once a hand is known to lead a robot. Each has a writer of its own.
TEST(RosWire, TakesForceAndEnergyOfARobot) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain());
  const auto forces = peer.writer(ddsTopic(hand, "teleop/remote_cf"), test::kWrenchType, Reliability::kBestEffort);
  const auto energies =
      peer.writer(ddsTopic(hand, "teleop/remote_energy_in"), test::kNumberType, Reliability::kReliable);
  ros.send(state());
  const HandCommand force = received(ros, *forces, test::wrenchOf("", {1, -2, 3}), RosInput::kRemoteCf);
  EXPECT_EQ(force.value, (std::array<double, 3>{1, -2, 3}));
  const HandCommand energy = received(ros, *energies, test::energyOf(0.125), RosInput::kRemoteEnergy);
  EXPECT_EQ(energy.value[0], 0.125);
  EXPECT_EQ(energy.own_frame, 1u);
  EXPECT_NE(energy.writer, 0u);
  EXPECT_NE(energy.writer, force.writer);
}

TEST(RosWire, MeetsProgramsThatAreKeptToThisMachine) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain(), test::Reach::kLoopback);
  const auto force = peer.writer(ddsTopic(hand, "servo_cf"), test::kWrenchType, Reliability::kReliable);
  EXPECT_EQ(received(ros, *force, test::wrenchOf("", {1, 2, 3})).value[2], 3);
  const auto poses = peer.reader(ddsTopic(hand, "measured_cp"), test::kPoseType, Reliability::kBestEffort);
  EXPECT_EQ(heard(ros, *poses).size(), test::poseOf(rosFrame(hand), {}).size());
}

TEST(RosWire, SaysWhenAFrameIsAnotherOne) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain());
  const auto force = peer.writer(ddsTopic(hand, "servo_cf"), test::kWrenchType, Reliability::kReliable);
  EXPECT_EQ(received(ros, *force, test::wrenchOf("tool0", {1, 2, 3})).own_frame, 0u);
}

// What cannot be a wrench is not sent on, and what comes after it is.
TEST(RosWire, LivesThroughSamplesThatAreMalformed) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain());
  const auto writer = peer.writer(ddsTopic(hand, "servo_cf"), test::kWrenchType, Reliability::kReliable);
  const Payload whole = test::wrenchOf("f", {1, 2, 3});
  received(ros, *writer, whole);
  std::vector<Payload> malformed;
  for (const std::size_t size : {4, 5, 8, 12, 16, 20, 40, 67})
    malformed.emplace_back(whole.begin(), whole.begin() + size);
  for (const std::uint32_t length : {0u, 0x7fffffffu, 0xffffffffu, 1000u}) {
    malformed.push_back(whole);
    std::memcpy(malformed.back().data() + 12, &length, sizeof length);
  }
  malformed.push_back(Payload(2000, 0xff));
  malformed.push_back({0xff, 0xff, 0, 0});
  for (const Payload& payload : malformed) writer->write(payload);
  std::size_t refused = 0;
  bool heard_after = false;
  test::waitFor([&] {
    writer->write(test::wrenchOf("", {7, 0, 0}));
    while (const auto command = ros.receive()) {
      if (command->input == RosInput::kMalformed) ++refused;
      // Those of `whole` that were still under way have the value 1.
      if (command->input == RosInput::kServoCf) {
        EXPECT_TRUE(command->value[0] == 1 || command->value[0] == 7);
      }
      heard_after |= command->input == RosInput::kServoCf && command->value[0] == 7;
    }
    return heard_after && refused > 0;
  });
  EXPECT_FALSE(ros.ended());
}

TEST(RosWire, NumbersThatAreNoneAreSentOnAsTheyCame) {
  const std::string hand = ownHand();
  RosProcess ros(taskOf(hand));
  FastPeer peer(ownDomain());
  const auto force = peer.writer(ddsTopic(hand, "servo_cf"), test::kWrenchType, Reliability::kReliable);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(received(ros, *force, test::wrenchOf("", {nan, 0, 0})).value[0]));
}

TEST(RosWire, AProgramOfAnotherVersionIsRefused) {
  RosTask task = taskOf(ownHand());
  task.version = "0.0.0";
  EXPECT_THROW(RosProcess{task}, Error);
}

}  // namespace
}  // namespace hl::test_ros_wire
