// A simulated hand as programs of ROS 2 see and move it: from its servo to Fast DDS, and back.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/clock.h"
#include "dds/fast_peer.h"
#include "dds/payloads.h"
#include "ros/hand_motion.h"
#include "ros/ros_bridge.h"
#include "ros/ros_process.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_ros_server {
namespace {

using test::FastPeer;
using test::Reliability;

// See test_ros_wire.cpp.
std::uint32_t testDomain() { return 1 + static_cast<std::uint32_t>(getpid()) % 100; }
std::string testSpace() { return "s" + std::to_string(getpid()); }

TouchSettings quietHand() {
  TouchSettings settings;
  settings.explore = false;
  return settings;
}

/// What a message and its header say: a place and an orientation, or two vectors.
struct Stamped {
  std::int64_t time_ns = 0;
  std::string frame;
  std::array<double, 3> value{};
  std::array<double, 4> more{};  // of two vectors the last is nothing
};

class RosServer : public ::testing::Test {
 protected:
  RosServer() {
    session_.start();
    bridge_.start();
  }
  std::unique_ptr<test::FastReader> reader(const char* name, const char* type) {
    return peer_.reader(ddsTopic(hand_, name), type, Reliability::kBestEffort);
  }
  std::unique_ptr<test::FastWriter> writer(const char* name, const char* type) {
    return peer_.writer(ddsTopic(hand_, name), type, Reliability::kReliable);
  }
  // Waits for the next one, and skips to the newest.
  static Stamped newestOf(test::FastReader& reader) {
    std::optional<test::Payload> payload;
    test::waitFor([&] {
      while (auto next = reader.take()) payload = std::move(next);
      return payload.has_value();
    });
    test::PayloadReader in(*payload);
    const std::int64_t seconds = in.number<std::int32_t>();
    const std::int64_t time_ns = 1'000'000'000 * seconds + in.number<std::uint32_t>();
    const std::string frame = in.text();
    const auto value = in.numbers<3>();
    return {time_ns, frame, value, in.numbers<4>()};
  }
  // The servo's own moments of this time and of kSlope_ns before it, the newest first. The clocks are read one after
  // the other, and steps are a millisecond apart. None where they have been overwritten.
  std::vector<ServoMoment> momentsUntil(std::int64_t system_ns) {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    const std::int64_t ahead_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec - monotonicNow_ns();
    const LogRing<ServoMoment>& moments = session_.moments();
    std::vector<ServoMoment> last;
    ServoMoment moment;
    for (std::uint64_t next = moments.pushed(); next > 0; --next) {
      if (!moments.read(next - 1, moment)) return {};
      const bool newest = std::abs(moment.time_ns + ahead_ns - system_ns) < 100'000;
      if (!last.empty() && last[0].time_ns - moment.time_ns > kSlope_ns) break;
      if (newest || !last.empty()) last.push_back(moment);
    }
    return last;
  }
  // A busy machine may hold the servo up, which is a fault: then a person arms again.
  Vec3 force() {
    const ServoView servo = test::servoOf(session_);
    if (servo.safety == SafetyState::kFault) session_.live().rearm();
    return servo.force_N;
  }
  std::uint64_t verdicts(CommandVerdict verdict) const {
    return bridge_.counts().verdicts[static_cast<std::size_t>(verdict)];
  }

  const std::string hand_ = testSpace() + "/hand";
  TouchSession session_{makeSnapshot(std::vector<Instance>{}, "nothing"), quietHand()};
  RosBridge bridge_{std::make_unique<RosProcess>(RosTask{HL_VERSION, testDomain(), {hand_}}),
                    {&session_},
                    250,
                    [](const std::string&) {},
                    TeleopOfHand{0, {1, 1, std::nullopt, 0.5}}};
  FastPeer peer_{testDomain()};
};

TEST_F(RosServer, PoseAndForceAreThoseOfTheServo) {
  const auto poses = reader("measured_cp", test::kPoseType);
  const auto wrenches = reader("measured_cf", test::kWrenchType);
  const auto forces = writer("servo_cf", test::kWrenchType);
  // Such forces that the hand moves, and no two moments are alike.
  int checked = 0, said = 0;
  test::waitFor([&] {
    forces->write(test::wrenchOf("", {std::sin(0.1 * ++said), 0.5, 0}));
    const Stamped pose = newestOf(*poses);
    EXPECT_EQ(pose.frame, rosFrame(hand_));
    if (const auto moments = momentsUntil(pose.time_ns); !moments.empty()) {
      EXPECT_EQ(Vec3(pose.value[0], pose.value[1], pose.value[2]), moments[0].finger_D);
      ++checked;
    }
    const Stamped wrench = newestOf(*wrenches);
    if (const auto moments = momentsUntil(wrench.time_ns); !moments.empty()) {
      EXPECT_EQ(Vec3(wrench.value[0], wrench.value[1], wrench.value[2]), moments[0].force_N);
      if (wrench.value[1] > 0) ++checked;
    }
    force();
    return checked > 50;
  });
}

TEST_F(RosServer, TheStylusIsThatOfTheServo) {
  const auto poses = reader("measured_cp", test::kPoseType);
  const auto twists = reader("measured_cv", test::kTwistType);
  int turns = 0, spins = 0, said = 0;
  test::waitFor([&] {
    session_.hand().turn(Eigen::Quaterniond(1, std::sin(0.05 * ++said), 0.2, 0));
    const Stamped pose = newestOf(*poses);
    if (const auto moments = momentsUntil(pose.time_ns); !moments.empty()) {
      const Stylus& stylus = moments[0].stylus;
      for (int i = 0; i < 4; ++i) EXPECT_EQ(pose.more[static_cast<std::size_t>(i)], stylus.turned.coeffs()[i]);
      if (std::abs(stylus.turned.x()) > 0.1) ++turns;
    }
    const Stamped twist = newestOf(*twists);
    if (const auto moments = momentsUntil(twist.time_ns); !moments.empty()) {
      EXPECT_EQ(Vec3(twist.more[0], twist.more[1], twist.more[2]), moments[0].stylus.spin_rad_s);
      if (moments[0].stylus.spin_rad_s.norm() > 0.1) ++spins;
    }
    return turns > 20 && spins > 20;
  });
}

// The line nearest to the places of the last 10 ms, by a QR decomposition of [1 t] in the place of sums.
TEST_F(RosServer, TheVelocityIsTheSlopeOfThePlaces) {
  const auto twists = reader("measured_cv", test::kTwistType);
  const auto forces = writer("servo_cf", test::kWrenchType);
  int checked = 0, said = 0;
  test::waitFor([&] {
    forces->write(test::wrenchOf("", {3 * std::sin(0.2 * ++said), 0, 0}));
    force();
    const Stamped twist = newestOf(*twists);
    const std::vector<ServoMoment> last = momentsUntil(twist.time_ns);
    if (last.size() < 2) return false;
    Eigen::MatrixX2d times(last.size(), 2);
    Eigen::MatrixX3d places(last.size(), 3);
    for (Eigen::Index i = 0; i < times.rows(); ++i) {
      const ServoMoment& moment = last[static_cast<std::size_t>(i)];
      times.row(i) << 1, 1e-9 * static_cast<double>(moment.time_ns - last[0].time_ns);
      places.row(i) = moment.finger_D.transpose();
    }
    const Vec3 slope = times.colPivHouseholderQr().solve(places).row(1).transpose();
    const Vec3 reported(twist.value[0], twist.value[1], twist.value[2]);
    EXPECT_LT((reported - slope).norm(), 1e-6);
    if (reported.norm() > 0.01) ++checked;
    return checked > 10;
  });
}

TEST_F(RosServer, AForceMovesTheHandAndItsEndLetsGo) {
  const auto wrenches = reader("measured_cf", test::kWrenchType);
  const auto poses = reader("measured_cp", test::kPoseType);
  const auto forces = writer("servo_cf", test::kWrenchType);
  const double before_m = newestOf(*poses).value[0];
  test::waitFor([&] {
    forces->write(test::wrenchOf(rosFrame(hand_), {1.5, 0, 0}));
    force();
    return std::abs(newestOf(*wrenches).value[0] - 1.5) < 1e-9 && newestOf(*poses).value[0] > before_m + 1e-3;
  });
  // Nothing more is said.
  test::waitFor([&] { return newestOf(*wrenches).value == std::array<double, 3>{}; });
  test::waitFor([&] { return bridge_.counts().ends > 0; });
}

TEST_F(RosServer, ASetPointMovesTheHand) {
  const auto poses = reader("measured_cp", test::kPoseType);
  const auto points = writer("servo_cp", test::kPoseType);
  const std::array<double, 3> before = newestOf(*poses).value;
  test::waitFor([&] {
    points->write(test::poseOf(rosFrame(hand_), {before[0], before[1] + 0.02, before[2]}));
    force();
    return newestOf(*poses).value[1] > before[1] + 1e-3;
  });
}

TEST_F(RosServer, OldCommandsAndThoseThatAreNoneAreCountedAndNotFelt) {
  const auto forces = writer("servo_cf", test::kWrenchType);
  test::waitFor([&] {
    forces->write(test::wrenchOf("", {3, 0, 0}), 60'000'000);
    return verdicts(CommandVerdict::kStale) > 0;
  });
  test::waitFor([&] {
    forces->write(test::wrenchOf("", {std::nan(""), 0, 0}));
    return verdicts(CommandVerdict::kNotANumber) > 0;
  });
  test::waitFor([&] {
    forces->write(test::wrenchOf("elsewhere", {3, 0, 0}));
    return verdicts(CommandVerdict::kOtherFrame) > 0;
  });
  test::waitFor([&] {
    forces->write({0, 1, 0, 0, 1});
    return verdicts(CommandVerdict::kMalformed) > 0;
  });
  EXPECT_EQ(verdicts(CommandVerdict::kTaken), 0u);
  EXPECT_TRUE(force().isZero(0));
}

/// A program beside this one, in the domain of the test.
class Started {
 public:
  Started(const std::string& name, std::vector<std::string> words) {
    words.insert(words.begin(), std::filesystem::read_symlink("/proc/self/exe").parent_path() / name);
    setenv("ROS_DOMAIN_ID", std::to_string(testDomain()).c_str(), 1);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (posix_spawn(&id_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
      throw std::runtime_error(words[0] + " cannot be started");
  }
  ~Started() {
    if (id_ != 0) end(SIGKILL);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  /// Its exit code; -1 where the signal has ended it.
  int end(int signal) {
    int status = 0;
    kill(id_, signal);
    waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t id_ = 0;
};

// The process that was started with this word among others; 0: there is none.
pid_t processOf(const std::string& word) {
  std::error_code gone;
  for (const auto& process : std::filesystem::directory_iterator("/proc", gone)) {
    std::ifstream words(process.path() / "cmdline");
    for (std::string one; std::getline(words, one, '\0');) {
      if (one == word) return std::stoi(process.path().filename().string());
    }
  }
  return 0;
}

// Whatever ends it: the hand is let go, its servo goes on, and whoever writes is heard again by the next hl-ros.
TEST_F(RosServer, HlRosMayDie) {
  const auto forces = writer("servo_cf", test::kWrenchType);
  const auto pushed = [&] {
    forces->write(test::wrenchOf("", {1, 0, 0}));
    return force().x() > 0;
  };
  test::waitFor(pushed);
  kill(processOf(hand_), SIGKILL);
  test::waitFor([&] { return force().isZero(0); });
  test::waitFor([&] { return bridge_.counts().starts == 1; });
  test::waitFor(pushed);
  EXPECT_TRUE(bridge_.counts().running);
  const std::uint64_t steps = session_.servoTotals().steps;
  test::waitFor([&] { return session_.servoTotals().steps > steps + 10; });
}

// The robot's wall is 10 mm below where it was at first; what it feels there the hand feels, and both count the energy.
TEST_F(RosServer, TheRobotOfTheExampleIsLedToItsWallAndTheHandFeelsIt) {
  const Started robot("examples/20_robot", {hand_, "600"});
  const auto set_points = reader("teleop/setpoint_cp", test::kPoseType);
  const auto points = writer("servo_cp", test::kPoseType);
  const auto taken = [&] { return bridge_.counts().received[static_cast<std::size_t>(RosInput::kRemoteCf)]; };
  test::waitFor([&] { return taken() > 10; });
  const Vec3 begin_D = test::servoOf(session_).finger_D;
  int said = 0;
  bool led = false, felt = false;
  test::waitFor([&] {
    const double y = begin_D.y() - 0.06 * std::min(1.0, 1e-3 * ++said);
    points->write(test::poseOf("", {begin_D.x(), y, begin_D.z()}));
    force();
    led = led || newestOf(*set_points).value[1] < -0.012;
    felt = felt || bridge_.counts().teleop->port.asked_N.y() > 0.1;
    return led && felt;
  });
}

TEST_F(RosServer, TheExampleLeadsTheHand) {
  const Vec3 before_D = test::servoOf(session_).finger_D;
  const Started example("examples/19_ros_circle", {hand_, "600"});
  test::waitFor([&] {
    force();
    return (test::servoOf(session_).finger_D - before_D).norm() > 0.01;
  });
}

TEST(RosOfHld, HldServesBothHandsAndTakesHlRosAlongWhenItEnds) {
  const std::string space = testSpace();
  Started hld("hld", {"--port", "0", "--devices", "2", "--log-level", "error", "--ros", space});
  FastPeer peer(testDomain());
  for (const char* hand : {"/left", "/right"}) {
    const auto reader = peer.reader(ddsTopic(space + hand, "buttons"), test::kJoyType, Reliability::kBestEffort);
    test::waitFor([&] { return reader->take().has_value(); });
  }
  EXPECT_NE(processOf(space + "/left"), 0);
  EXPECT_EQ(hld.end(SIGTERM), 0);
  EXPECT_EQ(processOf(space + "/left"), 0);
}

}  // namespace
}  // namespace hl::test_ros_server
