#include "touch/hand_mover.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/clock.h"
#include "base/duration.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"

namespace hl {

namespace {

constexpr std::int64_t kPeriod_ns = 16'666'667;
constexpr std::int64_t kPress_ns = 1'000'000'000;  // after which a button comes up by itself
constexpr double kApproach_s = 3.0;                // virtual time for the hand to reach the start
constexpr double kStartAbove_D = 0.020;            // m above the model at the hand

}  // namespace

HandMover::HandMover(Device& device, const TouchSettings& settings, const LiveSettings& live, LoopExchange& exchange,
                     SceneNow scene)
    : device_(device),
      hand_(device.hand()),
      script_(settings.script),
      live_(live),
      exchange_(exchange),
      scene_(std::move(scene)),
      exploring_(hasHand() && (settings.explore || settings.script)),
      firm_(settings.hand_firm) {}

// The hand moves freely, without force, on a virtual clock that ends now; the real clock then goes on from there.
void HandMover::bringToStart() {
  if (!hasHand()) return;
  const Workspace workspace = live_.workspace();
  const Box bounds = scene_()->bounds;
  // Of the scene, or of the first world that will be fitted to the hand: it must not appear around the finger.
  const double top_D = 0.5 * (bounds.empty() ? live_.side_D() : bounds.size().y() / workspace.world_per_device);
  const Vec3 goal_D = script_ ? clampToWorkspace(workspace.toDevice(script_->at(0))) : above(top_D);
  hand_->setHandGoal(goal_D);
  const std::int64_t now_ns = monotonicNow_ns();
  const std::int64_t step_ns = 1'000'000;
  for (std::int64_t t = now_ns - durationOf(kApproach_s).count(); t < now_ns; t += step_ns) {
    device_.read(t);
    device_.write(Vec3::Zero());
  }
}

Vec3 HandMover::above(double top_D) const { return clampToWorkspace(Vec3(0, top_D + kStartAbove_D, 0)); }

void HandMover::start(std::int64_t begin_ns) {
  if (!hasHand()) return;
  begin_ns_ = begin_ns;
  thread_.start("hand", [this] { run(); });
}

void HandMover::stop() { thread_.stop(); }

void HandMover::run() {
  LoopCounters counters;
  const auto move = [&](std::int64_t now_ns) {
    const Commands commands = takeCommands();
    follow(commands);
    follow(commands.buttons, now_ns);
    if (commands.turn) hand_->setHandTurn(*commands.turn);
    if (commands.gripper_rad) hand_->setHandGripper(*commands.gripper_rad);
  };
  runPeriodic(kPeriod_ns, thread_.running(), counters, [&](std::int64_t now_ns) { guarded([&] { move(now_ns); }); });
}

HandMover::Commands HandMover::takeCommands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

// A person, the script or the exploration, in this order.
void HandMover::follow(const Commands& commands) {
  if (commands.explore) {
    exploring_ = *commands.explore;
    exploration_.begin();
  }
  const bool aside = aside_.top_D >= 0;
  if (aside || !exploring_) still_.clear();
  if (aside) return holdAside();
  const Workspace workspace = live_.workspace();
  if (commands.goal_W) {
    exploring_ = false;
    hand_->setHandGoal(clampToWorkspace(workspace.toDevice(*commands.goal_W)));
  } else if (commands.release) {
    HandPlaces hand;
    exchange_.hand.read(hand);
    hand_->setHandGoal(clampToWorkspace(hand.finger_D));
  } else if (exploring_) {
    if (const auto goal_W = strokingGoal()) hand_->setHandGoal(clampToWorkspace(workspace.toDevice(*goal_W)));
    turnAsScripted();
  }
  hand_->setHandFirm(firm_);
}

void HandMover::follow(std::optional<std::uint32_t> buttons, std::int64_t now_ns) {
  if (buttons) {
    hand_->setHandButtons(*buttons);
    pressed_ns_ = now_ns;
  } else if (now_ns - pressed_ns_ > kPress_ns) {
    hand_->setHandButtons(0);
  }
}

void HandMover::turnAsScripted() const {
  if (!script_) return;
  const double time_s = seconds(monotonicNow_ns() - begin_ns_);
  if (const auto turned = script_->turnedAt(time_s)) hand_->setHandTurn(*turned);
  if (const auto gripper_rad = script_->gripperAt(time_s)) hand_->setHandGripper(*gripper_rad);
}

// With nothing to stroke the hand waits.
std::optional<Vec3> HandMover::strokingGoal() {
  const std::int64_t now_ns = monotonicNow_ns();
  const double time_s = seconds(now_ns - begin_ns_);
  if (script_) return script_->at(time_s);
  const std::shared_ptr<const Snapshot> scene = scene_();
  if (scene->bounds.empty()) return {};
  return exploration_.goal({still_.of(scene), now_ns}, exploringHand(), time_s);
}

ExploringHand HandMover::exploringHand() {
  const Workspace workspace = live_.workspace();
  HandPlaces hand;
  exchange_.hand.read(hand);
  const DeviceInfo& info = device_.info();
  return {workspace.toWorld(hand.proxy_D),
          live_.radius_W(),
          workspace.world_per_device,
          pressOf(firm_, live_.stiffness_N_m(), workspace.world_per_device),
          {workspace.toWorld(info.workspace_min), workspace.toWorld(info.workspace_max)}};
}

Vec3 HandMover::clampToWorkspace(const Vec3& goal_D) const {
  return goal_D.cwiseMax(device_.info().workspace_min).cwiseMin(device_.info().workspace_max);
}

void HandMover::setGoal(const Vec3& goal_W) {
  if (!goal_W.allFinite()) return;
  const std::lock_guard lock(mutex_);
  commands_.goal_W = goal_W;
  commands_.release = false;
}

void HandMover::release() {
  const std::lock_guard lock(mutex_);
  commands_.release = true;
  commands_.goal_W.reset();
}

bool HandMover::moveAside(double top_D, double most_s) {
  if (!hasHand()) return true;
  aside_.reached = false;
  aside_.top_D = std::max(0.0, top_D);
  constexpr auto kLook = std::chrono::milliseconds(5);
  const std::int64_t end_ns = monotonicNow_ns() + durationOf(most_s).count();
  while (thread_.running() && !aside_.reached && monotonicNow_ns() < end_ns) std::this_thread::sleep_for(kLook);
  return aside_.reached;
}

// What was wanted meanwhile is over.
void HandMover::free() {
  {
    const std::lock_guard lock(mutex_);
    commands_.goal_W.reset();
    commands_.release = false;
  }
  aside_.top_D = kFree;
}

void HandMover::holdAside() {
  constexpr double kThere_m = 0.005;
  const Vec3 goal_D = above(aside_.top_D);
  hand_->setHandGoal(goal_D);
  HandPlaces hand;
  exchange_.hand.read(hand);
  aside_.reached = (hand.finger_D - goal_D).norm() < kThere_m;
}

void HandMover::press(std::uint32_t buttons) {
  const std::lock_guard lock(mutex_);
  commands_.buttons = buttons;
}

// The axes of the device are those of the world.
void HandMover::turn(const Eigen::Quaterniond& turned_W) {
  const std::lock_guard lock(mutex_);
  commands_.turn = turned_W;
}

void HandMover::openGripper(double gripper_rad) {
  const std::lock_guard lock(mutex_);
  commands_.gripper_rad = gripper_rad;
}

void HandMover::setExplore(bool on) {
  const std::lock_guard lock(mutex_);
  commands_.explore = on;
}

}  // namespace hl
