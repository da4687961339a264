// FakeScript: the hand of a fake that another process has loaded, when HL_FAKE_REPORT names a file. It waits 20 mm
// above the origin; once the servo runs it presses to 20 mm below and comes back, until it has felt something. It
// writes what came of it: a line "touched" when the device has pulled with half a newton, or "nothing" when it has not
// in kStrokes, as when the servo is in a fault; and "closed F" with the force in N that is left when it has been
// closed. The second device writes into the file with ".1" behind its name.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include "fake_arm.h"

namespace hl::test {

class FakeScript {
 public:
  explicit FakeScript(FakeArm& arm, std::size_t number = 0) : arm_(arm) {
    const char* file = std::getenv("HL_FAKE_REPORT");
    if (file == nullptr) return;
    report_.open(number == 0 ? file : file + ("." + std::to_string(number)));
    arm_.useVirtualClock();
    arm_.setHandGoal({0, 0.02, 0});
    for (int i = 0; i < 2000; ++i) arm_.advance(1e-3);
    arm_.useRealClock();
  }
  void pulled() {
    if (!report_.is_open()) return;
    if (reported_) return;
    if (++pulls_ % kPullsOfAStroke == 0) arm_.setHandGoal({0, pulls_ / kPullsOfAStroke % 2 == 1 ? -0.02 : 0.02, 0});
    const bool touched = arm_.strongest_N() >= 0.5;
    reported_ = touched || pulls_ >= kStrokes * kPullsOfAStroke;
    if (reported_) report_ << (touched ? "touched" : "nothing") << std::endl;
  }
  void closed() {
    if (report_.is_open()) report_ << "closed " << arm_.force_D().norm() << std::endl;
  }

 private:
  static constexpr int kPullsOfAStroke = 500;
  static constexpr int kStrokes = 20;

  FakeArm& arm_;
  std::ofstream report_;
  int pulls_ = 0;
  bool reported_ = false;
};

}  // namespace hl::test
