// The exploring hand with everything real but the clock: simulated device in a hand, servo step, proxy. However it
// begins, it presses by about a newton, and strokes.
#include "touch/exploration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>

#include "bodies/test_worlds.h"
#include "builtin.h"
#include "device/simulated_device.h"
#include "touch/live_settings.h"
#include "touch/touch_step.h"

namespace hl::test_exploration {
namespace {

constexpr double kMost_N = 2;      // what is felt of a hand that presses by one newton, and lands
constexpr double kLetGo_s = 0.25;  // a hand that was pressed deep has come up by then
constexpr int kStepsOfHand = 16;   // at 1 kHz
constexpr double kPersonPress_D = 0.04;

SimulatedDeviceSettings deviceOf(bool firm) {
  SimulatedDeviceSettings device;
  device.firm = firm;
  device.step_s = 50e-6;
  return device;
}

class Hand {
 public:
  Hand(const Model& model, bool firm)
      : scene_(makeSnapshot(model)),
        device_(deviceOf(firm)),
        scenes_(scene_),
        proxy_(scenes_, {}),
        live_({}, device_.info(), scene_->bounds),
        firm_(firm) {
    settings_ = ServoSettings::of(device_.info());
    live_.proxyCommands(commands_);
    device_.place(clamped({0, 0.09, 0}), Vec3::Zero());
    device_.setHandGoal(clamped({0, 0.09, 0}));
    arm(step_.servo());
    run(0.7);
  }
  // As a person moves it, from above and beside to somewhere.
  void reach(const Vec3& goal_D, double duration_s) {
    device_.setHandGoal(clamped(goal_D));
    run(duration_s);
  }
  void release() {
    device_.setHandGoal(clamped(sample_.position));
    run(0.5);
  }
  void explore(double duration_s) {
    const Workspace& workspace = commands_.workspace;
    const DeviceInfo& info = device_.info();
    const auto steps = static_cast<int>(1e3 * duration_s);
    for (int i = 0; i < steps; ++i) {
      if (i % kStepsOfHand == 0) {
        const ExploringHand hand{workspace.toWorld(proxy_D()),
                                 commands_.radius_W,
                                 workspace.world_per_device,
                                 pressOf(firm_, settings_.stiffness_N_m, workspace.world_per_device),
                                 {workspace.toWorld(info.workspace_min), workspace.toWorld(info.workspace_max)}};
        const Vec3 goal = exploration_.goal({*scene_, time_ns_}, hand, 1e-9 * static_cast<double>(time_ns_));
        device_.setHandGoal(clamped(workspace.toDevice(goal)));
      }
      step();
      if (i < 1e3 * kLetGo_s) continue;
      strongest_N_ = std::max(strongest_N_, out_.force_N.norm());
      touched_ += out_.force_N.norm() > 0.5 ? 1 : 0;
    }
  }
  Vec3 proxy_D() const { return step_.target().valid ? step_.target().proxy_D : sample_.position; }
  double force_N() const { return out_.force_N.norm(); }
  double strongest_N() const { return strongest_N_; }
  int touched() const { return touched_; }

 private:
  void run(double duration_s) {
    for (int i = 0; i < static_cast<int>(1e3 * duration_s); ++i) step();
  }
  void step() {
    sample_ = device_.read(time_ns_);
    out_ = step_.onTime(proxy_, commands_, settings_, sample_);
    device_.write(out_.force_N);
    time_ns_ += 1'000'000;
  }
  Vec3 clamped(const Vec3& goal_D) const {
    return goal_D.cwiseMax(device_.info().workspace_min).cwiseMin(device_.info().workspace_max);
  }

  std::shared_ptr<const Snapshot> scene_;
  SimulatedDevice device_;
  SnapshotSlot scenes_;
  ProxyLoop proxy_;
  LiveSettings live_;
  ProxyCommands commands_;
  ServoSettings settings_;
  TouchStep step_;
  Exploration exploration_;
  DeviceSample sample_;
  ServoOutput out_;
  std::int64_t time_ns_ = 0;
  bool firm_;
  double strongest_N_ = 0;
  int touched_ = 0;
};

Model modelOf(const std::string& name) {
  return name == "box" ? test::boxModel(Vec3(0.3, 0.2, 0.25)) : makeBuiltinScene(name);
}

class Begun : public testing::TestWithParam<const char*> {};

// In contact, pressed deep, in the air, beneath the model; the exploration begins while the hand moves, or rests.
TEST_P(Begun, AnywhereItPressesByAboutANewtonAndStrokes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int run = 0; run < 6; ++run) {
    SCOPED_TRACE(run);
    Hand hand(modelOf(GetParam()), run % 3 == 2);
    const Vec3 side = Vec3(part(random), part(random), part(random)).normalized();
    hand.reach(0.1 * side, 0.8);
    if (run % 4 != 0) hand.reach(kPersonPress_D * part(random) * side, 0.3 + 0.3 * part(random));
    if (run % 2 == 1) hand.release();
    hand.explore(8);
    EXPECT_LT(hand.strongest_N(), kMost_N);
    EXPECT_GT(hand.touched(), 1000) << "of 8000 ms";
  }
}

INSTANTIATE_TEST_SUITE_P(Exploration, Begun, testing::Values("box", "sphere:2000", "teapot", "plane:2000"));

// As an outside user did it: pressed at the front of a box, released, explored.
TEST(Exploration, OfAHandThatRestsAtABoxLiftsOff) {
  Hand hand(modelOf("box"), false);
  hand.reach({0, 0.02, 0.09}, 0.6);
  hand.reach({0, 0, 0.02}, 1);
  EXPECT_GT(hand.force_N(), 1);
  hand.release();
  EXPECT_LT(hand.force_N(), 0.6);
  hand.explore(4);
  EXPECT_LT(hand.strongest_N(), kMost_N);
}

}  // namespace
}  // namespace hl::test_exploration
