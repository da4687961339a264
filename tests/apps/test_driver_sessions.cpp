// Whole sessions with each driver against its fake: what the hand meets is felt at the device.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "builtin.h"
#include "device/fakes/bench.h"
#include "device/fakes/haply_service.h"
#include "temp_folder.h"
#include "touch/session_views.h"
#include "touch/touch_session.h"
#include "wait_for.h"

namespace hl::test::test_driver_sessions {
namespace {

// A busy machine may lose a device for a moment, which is a fault: then a person arms again.
void pressAndFeel(TouchSession& session, Bench& bench) {
  const Vec3 below_D(0, -0.02, 0);
  if (session.hasHand()) {
    session.hand().setGoal(
        session.live().workspace().toWorld(below_D));  // only the session may move a hand that it holds
  } else {
    bench.arm().setHandGoal(below_D);
  }
  waitFor([&] {
    if (servoOf(session).safety == SafetyState::kFault) session.live().rearm();
    return bench.arm().force_D().y() > 0.5;
  });
}

class DriverSession : public testing::TestWithParam<BenchKind> {};

TEST_P(DriverSession, AHandThatPressesOnAPlaneFeelsItAndALostDeviceIsAFaultUntilItIsArmedAgain) {
  const auto bench = GetParam().make();
  auto device = bench->device();
  device->open();
  bench->arm().setHandGoal(Vec3(0, 0.02, 0));
  waitFor([&] { return bench->arm().encoders().y() > 0.018; });
  TouchSession session(makeSnapshot(makeBuiltinScene("plane:2000"), HierarchyKind::kBvh), {}, std::move(device));
  session.start();
  pressAndFeel(session, *bench);
  if (!session.hasHand()) {
    bench->arm().lost = true;
    waitFor([&] { return servoOf(session).safety == SafetyState::kFault; });
    EXPECT_EQ(servoOf(session).fault, FaultReason::kDeviceLost);
    EXPECT_EQ(servoOf(session).force_N, Vec3(Vec3::Zero()));
    waitFor([&] { return bench->arm().force_D().norm() < 1e-12; });
    // The proxy will start where the finger is then: above the plane again.
    bench->arm().setHandGoal(Vec3(0, 0.02, 0));
    waitFor([&] { return bench->arm().encoders().y() > 0.018; });
    bench->arm().lost = false;
    waitFor([&] { return servoOf(session).finger_D.y() > 0.015; });
    pressAndFeel(session, *bench);
  }
  session.stop();
  waitFor([&] { return bench->arm().force_D().norm() < 1e-12; });
}

INSTANTIATE_TEST_SUITE_P(Drivers, DriverSession, testing::ValuesIn(benchKinds()),
                         [](const auto& of) { return of.param.name; });

// ---- hl touch itself ------------------------------------------------------------------------------------------------

/// `hl touch` on a plane with `device`, or with two, ended when it is destroyed.
class TouchProcess {
 public:
  explicit TouchProcess(const std::string& device, const std::string& second = "sim") {
    pid_ = fork();
    if (pid_ != 0) return;
    const bool two = second != "sim";
    execl(HL_PROGRAM, HL_PROGRAM, "touch", "plane:2000", "--port", "0", "--no-open", "--device", device.c_str(),
          two ? "--device" : nullptr, second.c_str(), nullptr);
    _exit(127);
  }
  int end() const {
    kill(pid_, SIGTERM);
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

std::vector<std::string> linesOf(const std::string& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The hand of a fake with a script strokes until it feels something. A busy machine may cause a fault, which lasts:
// then a person begins again.
void expectTouch(const std::string& device, const std::string& report) {
  std::vector<std::string> lines{"nothing"};
  while (lines.front() == "nothing") {
    std::filesystem::remove(report);
    const TouchProcess touch(device);
    waitFor([&] { return !linesOf(report).empty(); });
    EXPECT_EQ(touch.end(), 0);
    lines = linesOf(report);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[1], "closed 0");
  }
  EXPECT_EQ(lines.front(), "touched");
}

// The same of two devices at once: both hands feel the plane, whoever is first.
void expectBothTouch(const std::string& device, const std::string& second, const std::string& report) {
  const std::vector<std::string> reports{report, report + ".1"};
  const auto began = [&](const std::string& file, const char* word) {
    const std::vector<std::string> lines = linesOf(file);
    return !lines.empty() && lines.front() == word;
  };
  setenv("HL_FAKE_DEVICES", "2", 1);
  for (bool touched = false; !touched;) {
    for (const std::string& file : reports) std::filesystem::remove(file);
    const TouchProcess touch(device, second);
    waitFor([&] { return !linesOf(reports[0]).empty() && !linesOf(reports[1]).empty(); });
    EXPECT_EQ(touch.end(), 0);
    touched = began(reports[0], "touched") && began(reports[1], "touched");
    for (const std::string& file : reports) {
      ASSERT_EQ(linesOf(file).size(), 2U);
      EXPECT_EQ(linesOf(file)[1], "closed 0");
    }
  }
  unsetenv("HL_FAKE_DEVICES");
}

struct LibraryDriver {
  const char* kind;
  const char* variable;
  const char* fake;
  const char* first;
  const char* second;
};

class TouchCommand : public testing::TestWithParam<LibraryDriver> {};

TEST_P(TouchCommand, FeelsThroughTheVendorsLibrary) {
  const std::string report = tempFile("report");
  setenv(GetParam().variable, GetParam().fake, 1);
  setenv("HL_FAKE_REPORT", report.c_str(), 1);
  expectTouch(GetParam().kind, report);
  expectBothTouch(GetParam().first, GetParam().second, report);
}

// The fake is loaded in place of libusb, so the driver's own USB code talks to it, and loads its firmware first.
TEST(TouchFalcon, FeelsThroughLibusb) {
  const std::string report = tempFile("falcon_report"), firmware = tempFile("firmware");
  std::ofstream(firmware, std::ios::binary) << std::string(700, '\x5a');
  setenv("LD_LIBRARY_PATH", HL_FAKE_USB_FOLDER, 1);
  setenv("HL_FALCON_FIRMWARE", firmware.c_str(), 1);
  setenv("HL_FAKE_REPORT", report.c_str(), 1);
  expectTouch("falcon", report);
  expectBothTouch("falcon:0", "falcon:1", report);
  unsetenv("LD_LIBRARY_PATH");
}

TEST(TouchHaply, FeelsThroughTheVendorsService) {
  FakeArm arm;
  HaplyService service(arm, "3.5.0");
  while (arm.strongest_N() < 0.5) {
    const int known = service.introductions;
    const TouchProcess touch("haply:" + service.url());
    waitFor([&] { return service.introductions > known; });
    for (int stroke = 0; stroke < 10 && arm.strongest_N() < 0.5; ++stroke) {
      const double goal_m = stroke % 2 == 0 ? 0.02 : -0.02;
      arm.setHandGoal(Vec3(0, goal_m, 0));
      waitFor([&] { return std::abs(arm.encoders().y() - goal_m) < 0.01 || arm.strongest_N() >= 0.5; });
    }
    EXPECT_EQ(touch.end(), 0);
  }
  waitFor([&] { return arm.force_D().norm() < 1e-12; });
}

INSTANTIATE_TEST_SUITE_P(Drivers, TouchCommand,
                         testing::Values(LibraryDriver{"dhd", "HL_DHD_LIBRARY", HL_FAKE_DHD, "dhd:1", "dhd:0"},
                                         LibraryDriver{"hd", "HL_HD_LIBRARY", HL_FAKE_HD, "hd:Left Device",
                                                       "other=hd:Right Device"}),
                         [](const auto& of) { return of.param.kind; });

}  // namespace
}  // namespace hl::test::test_driver_sessions
