// A hand and a robot in two network namespaces, 100 ms apart each way, with a twentieth of the packets lost: the hand
// goes to the robot's wall and off, and the two sides' own totals say that the network gives no more than its tanks.
// Ten minutes of it were run by hand: docs/teleoperation.md.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "line/line.h"
#include "ros/keystore.h"
#include "ros/ros_bridge.h"
#include "ros/ros_process.h"
#include "temp_folder.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_teleop_line {
namespace {

constexpr std::uint32_t kDomain = 3;  // in namespaces of this test alone
constexpr int kHandEnd = 1, kRobotEnd = 2;

std::string enclaveOf(const std::string& name) { return test::tempFile("teleop_keys") + "/enclaves/" + name; }

// The settings of Cyclone DDS: the device of the line, and its keys.
void writeSettings(const std::string& file) {
  const auto library = [](const char* name, const char* functions) {
    return std::string("<Library path=\"dds_security_") + name + "\" initFunction=\"init_" + functions +
           "\" finalizeFunction=\"finalize_" + functions + "\"/>";
  };
  const auto key = [](const char* element, const char* name) {
    return std::string("<") + element + ">file:" + enclaveOf("robot") + "/" + name + "</" + element + ">";
  };
  std::ofstream(file) << "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"line0\"/>"
                         "</Interfaces></General><Security><Authentication>"
                      << library("auth", "authentication") << key("IdentityCA", "identity_ca.cert.pem")
                      << key("IdentityCertificate", "cert.pem") << key("PrivateKey", "key.pem")
                      << "</Authentication><Cryptographic>" << library("crypto", "crypto")
                      << "</Cryptographic><AccessControl>" << library("ac", "access_control")
                      << key("PermissionsCA", "permissions_ca.cert.pem") << key("Governance", "governance.p7s")
                      << key("Permissions", "permissions.p7s") << "</AccessControl></Security></Domain></CycloneDDS>";
}

/// The example, at its end of the line; what it prints goes to a file.
class Robot {
 public:
  Robot(const line::Line& line, const std::string& settings, const std::string& log) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "examples/20_robot";
    const std::string uri = "CYCLONEDDS_URI=file://" + settings, domain = "ROS_DOMAIN_ID=" + std::to_string(kDomain);
    const std::array<const char*, 4> words{program.c_str(), "lab/hand", "3600", nullptr};
    const std::array<const char*, 3> environment{uri.c_str(), domain.c_str(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    line.inside(kRobotEnd, [&] {
      posix_spawn(&id_, program.c_str(), &files, nullptr, const_cast<char**>(words.data()),
                  const_cast<char**>(environment.data()));
    });
    posix_spawn_file_actions_destroy(&files);
  }
  ~Robot() {
    if (id_ == 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

 private:
  pid_t id_ = 0;
};

/// Of the last whole line that the robot has printed, mJ.
struct RobotTotals {
  double put_in_mJ = 0, given_mJ = 0;
};

std::optional<RobotTotals> lastOf(const std::string& log) {
  std::ifstream in(log);
  std::optional<RobotTotals> totals;
  for (std::string text; std::getline(in, text) && !in.eof();) {
    RobotTotals said;
    const auto at = text.find("put in");
    if (at != text.npos &&
        std::sscanf(text.c_str() + at, "put in %lf mJ, given %lf mJ", &said.put_in_mJ, &said.given_mJ) == 2)
      totals = said;
  }
  return totals;
}

TEST(TeleopOnALine, TheNetworkGivesNoMoreThanItsTanks) {
  if (const auto why = line::lineRefusal()) GTEST_SKIP() << *why;
  const line::Line line(2, "delay 100 jitter 5 loss 5");
  makeEnclaves(test::tempFile("teleop_keys"), {"hand", "robot"}, kDomain);
  writeSettings(test::tempFile("robot.xml"));
  TouchSettings quiet;
  quiet.explore = false;
  TouchSession session(makeSnapshot(std::vector<Instance>{}, "nothing"), quiet);
  std::unique_ptr<RosProcess> process;
  line.inside(kHandEnd, [&] {
    process =
        std::make_unique<RosProcess>(RosTask{HL_VERSION, kDomain, {"lab/hand"}, {"line0", enclaveOf("hand"), {}}});
  });
  session.start();
  RosBridge bridge(
      std::move(process), {&session}, 250, [](const std::string&) {}, TeleopOfHand{0, {1, 1, std::nullopt, 0.5}});
  bridge.start();
  const std::string log = test::tempFile("robot.log");
  const Robot robot(line, test::tempFile("robot.xml"), log);
  test::waitFor([&] { return bridge.counts().received[static_cast<std::size_t>(RosInput::kRemoteCf)] > 10; });
  test::waitFor([&] { return lastOf(log).has_value(); });

  // Four strokes to the wall and off, each until the robot says that it has pressed more, and is free.
  const Vec3 begin_D = test::servoOf(session).finger_D;
  const auto go = [&](double y_m) {
    if (test::servoOf(session).safety == SafetyState::kFault) session.live().rearm();  // of a busy machine
    session.hand().setGoal(session.live().workspace().toWorld(begin_D + Vec3(0, y_m, 0)));
  };
  for (int stroke = 0; stroke < 4; ++stroke) {
    const RobotTotals before = *lastOf(log);
    test::waitFor([&] {
      go(-0.03);
      return lastOf(log)->given_mJ > before.given_mJ;
    });
    test::waitFor([&] {
      go(0.02);
      return lastOf(log)->put_in_mJ > before.put_in_mJ;
    });
  }
  const HLteleopPort hand = bridge.counts().teleop->port.energy;
  const RobotTotals far = *lastOf(log);
  EXPECT_GT(hand.given_J, 0);
  EXPECT_GE(1e3 * (hand.put_in_J - hand.given_J) + far.put_in_mJ - far.given_mJ, -2e3 * HL_TELEOP_TANK_J);
  EXPECT_LE(hand.given_J, hand.put_in_J + HL_TELEOP_TANK_J + hand.received_J);
  bridge.stop();
  std::filesystem::remove_all(test::tempFile("teleop_keys"));
}

}  // namespace
}  // namespace hl::test_teleop_line
