#include "ros/command_judge.h"

#include <algorithm>

#include "ros/command_values.h"

namespace hl {

namespace {

// Since it was sent. A clock that is ahead counts as none.
std::int64_t ageOf_ns(const HandCommand& command, std::int64_t now_ns) {
  constexpr std::int64_t kOld_ns = 2 * kCommandLife_ns;
  const std::int64_t on_the_way_ns = std::clamp<std::int64_t>(command.age_ns, 0, kOld_ns);
  return on_the_way_ns + waited_ns(command, now_ns, kOld_ns);
}

}  // namespace

CommandJudge::CommandJudge(const DeviceInfo& device) : device_(device) {}

CommandVerdict CommandJudge::judge(const HandCommand& command, std::int64_t now_ns) {
  if (command.input != RosInput::kServoCf && command.input != RosInput::kServoCp) return CommandVerdict::kMalformed;
  if (!vectorOf(command).allFinite()) return CommandVerdict::kNotANumber;
  if (command.own_frame != 1) return CommandVerdict::kOtherFrame;
  const std::int64_t age_ns = ageOf_ns(command, now_ns);
  if (age_ns >= kCommandLife_ns) return CommandVerdict::kStale;
  take(command, now_ns + kCommandLife_ns - age_ns);
  return CommandVerdict::kTaken;
}

void CommandJudge::take(const HandCommand& command, std::int64_t until_ns) {
  pulls_ = true;
  if (command.input == RosInput::kServoCf) {
    pull_.force_N = cutTo(vectorOf(command), device_.force_max_N);
    pull_.force_until_ns = until_ns;
    return;
  }
  pull_.place_D = vectorOf(command).cwiseMax(device_.workspace_min).cwiseMin(device_.workspace_max);
  pull_.spring_N_m = std::min(kSetPointSpring_N_m, device_.stiffness_max_N_m);
  pull_.damping_Ns_m = device_.damping_Ns_m;
  pull_.spring_until_ns = until_ns;
}

bool CommandJudge::takeEnd(std::int64_t now_ns) {
  if (!pulls_ || now_ns < std::max(pull_.force_until_ns, pull_.spring_until_ns)) return false;
  pulls_ = false;
  return true;
}

}  // namespace hl
