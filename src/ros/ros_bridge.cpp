#include "ros/ros_bridge.h"

#include <time.h>

#include <algorithm>

#include "base/clock.h"
#include "base/text.h"
#include "ros/hand_motion.h"

namespace hl {

namespace {

// So late the thread notices that it is to end.
constexpr std::int64_t kLongestWait_ns = 20'000'000;

constexpr std::array<const char*, static_cast<std::size_t>(CommandVerdict::kVerdicts)> kWhyRefused{
    "", "a sample is malformed", "a number is none, or infinite",
    "a frame is not that of the hand, NAMESPACE/HAND/base, nor empty", "a command comes too late"};

// How far the system clock is ahead of the monotonic one. It may be set at any time, so it is asked each time.
std::int64_t toSystem_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec - monotonicNow_ns();
}

std::string rosName(const std::string& device) {
  std::string name;
  for (const char c : device) {
    const char allowed = isLetterOrDigit(c) ? c : '_';
    if (allowed != '_' || !name.ends_with('_')) name += allowed;
  }
  return name.empty() ? "hand" : name;
}

template <typename Counts, std::size_t kCount>
std::array<std::uint64_t, kCount> read(const std::array<Counts, kCount>& counts) {
  std::array<std::uint64_t, kCount> numbers{};
  std::copy(counts.begin(), counts.end(), numbers.begin());
  return numbers;
}

}  // namespace

std::vector<std::string> rosHands(const std::string& name_space, const std::vector<std::string>& devices) {
  std::vector<std::string> hands;
  for (const std::string& device : devices) {
    std::string name = rosName(device);
    for (int number = 2; std::find(hands.begin(), hands.end(), name_space + "/" + name) != hands.end(); ++number)
      name = rosName(device + "_" + std::to_string(number));
    hands.push_back(name_space + "/" + name);
  }
  return hands;
}

RosBridge::RosBridge(std::unique_ptr<RosLink> link, const std::vector<TouchSession*>& hands, double rate_Hz,
                     ReportLine report, const std::optional<TeleopOfHand>& teleop)
    : link_(std::move(link)), period_ns_(static_cast<std::int64_t>(1e9 / rate_Hz)), report_(std::move(report)) {
  for (TouchSession* const session : hands) hands_.push_back({session, CommandJudge(session->deviceInfo())});
  if (!teleop) return;
  Hand& hand = hands_.at(teleop->hand);
  hand.leading.emplace(Leading{teleop->settings, RemoteJudge(hand.session->deviceInfo(), teleop->settings),
                               TeleopClutch(teleop->settings)});
  teleop_.emplace();
}

void RosBridge::start() {
  thread_.start("ros", [this] { run(); });
}

void RosBridge::stop() {
  if (!thread_.stop()) return;
  for (const Hand& hand : hands_) {
    hand.session->pull({});
    if (hand.leading) hand.session->setRemote({});
  }
}

void RosBridge::run() {
  std::int64_t next_ns = monotonicNow_ns();
  while (thread_.running()) {
    link_->wait(std::min(next_ns - monotonicNow_ns(), kLongestWait_ns));
    takeCommands();
    if (link_->ended()) startAgain();
    const std::int64_t now_ns = monotonicNow_ns();
    if (now_ns < next_ns) continue;
    publishHands();
    // What could not be published in time is not published later.
    next_ns = std::max(next_ns + period_ns_, now_ns);
  }
}

void RosBridge::startAgain() {
  linked_ = false;
  report_("hl-ros has ended: hands are no topics of ROS 2 until it is there again");
  while (thread_.running()) {
    // Commands are looked at all the while, as hands are let go that wait for them.
    pauses_.wait([this] {
      takeCommands();
      return thread_.running().load();
    });
    if (!thread_.running() || !link_->startAgain()) continue;
    ++starts_;
    linked_ = true;
    return report_("hl-ros is there again");
  }
}

void RosBridge::takeCommands() {
  while (const std::optional<HandCommand> command = link_->receive()) {
    const auto input = static_cast<std::size_t>(command->input);
    if (input < received_.size()) ++received_[input];
    const bool known = command->hand < hands_.size();
    Hand* const hand = known ? &hands_[command->hand] : nullptr;
    const CommandVerdict verdict = known ? take(*hand, *command) : CommandVerdict::kMalformed;
    if (verdicts_[static_cast<std::size_t>(verdict)]++ == 0) reportRefusal(verdict);
  }
  for (Hand& hand : hands_) {
    if (hand.judge.takeEnd(monotonicNow_ns())) ++ends_;
  }
}

CommandVerdict RosBridge::take(Hand& hand, const HandCommand& command) {
  const bool from_robot = command.input == RosInput::kRemoteCf || command.input == RosInput::kRemoteEnergy;
  if (from_robot && !hand.leading) return CommandVerdict::kMalformed;
  const std::int64_t now_ns = monotonicNow_ns();
  const CommandVerdict verdict =
      from_robot ? hand.leading->judge.judge(command, now_ns) : hand.judge.judge(command, now_ns);
  if (verdict != CommandVerdict::kTaken) return verdict;
  if (from_robot) giveInput(hand);
  if (!from_robot) hand.session->pull(hand.judge.pull());
  return verdict;
}

void RosBridge::giveInput(const Hand& hand) {
  RemoteInput input = hand.leading->judge.input();
  input.engaged = hand.leading->clutch.engaged();
  hand.session->setRemote(input);
}

// Where the robot is to be, by the hand's newest moment, and what its side may give.
void RosBridge::lead(Hand& hand, const HandMotion& motion, RosHandState& state) {
  Leading& leading = *hand.leading;
  leading.clutch.follow(motion.newest.finger_D, motion.newest.buttons, hand.session->makesForce());
  giveInput(hand);
  hand.session->readRemote(leading.port);
  const Vec3 velocity_m_s =
      leading.clutch.engaged() ? Vec3(leading.settings.scale * motion.velocity_m_s) : Vec3(Vec3::Zero());
  state.leads_robot = 1;
  state.given_up_J = leading.port.energy.sent_J / leading.settings.jouleScale();
  for (std::size_t i = 0; i < 3; ++i) {
    state.set_point[i] = leading.clutch.setPoint()[static_cast<Eigen::Index>(i)];
    state.set_point_velocity[i] = velocity_m_s[static_cast<Eigen::Index>(i)];
  }
  const std::lock_guard lock(teleop_mutex_);
  teleop_ = TeleopView{leading.clutch.engaged(), leading.port};
}

void RosBridge::reportRefusal(CommandVerdict verdict) {
  if (verdict == CommandVerdict::kTaken) return;
  report_(std::string("from ROS 2: ") + kWhyRefused[static_cast<std::size_t>(verdict)] +
          ": left out, as will be others, which are counted in /metrics and not told");
}

void RosBridge::publishHands() {
  const std::int64_t to_system_ns = toSystem_ns();
  for (std::uint32_t i = 0; i < hands_.size(); ++i) {
    const std::optional<HandMotion> motion = newestMotion(hands_[i].session->moments());
    if (!motion || motion->newest.time_ns == hands_[i].published_ns) continue;
    hands_[i].published_ns = motion->newest.time_ns;
    const bool has_gripper = hands_[i].session->deviceInfo().gripper_max_rad > 0;
    RosHandState state = stateOf(i, *motion, has_gripper, to_system_ns);
    if (hands_[i].leading) lead(hands_[i], *motion, state);
    ++(link_->send(state) ? states_ : states_lost_);
  }
}

RosCounts RosBridge::counts() const {
  const std::lock_guard lock(teleop_mutex_);
  return {linked_, states_, states_lost_, read(received_), read(verdicts_), ends_, starts_, teleop_};
}

}  // namespace hl
