#include "ros/remote_judge.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "ros/command_values.h"

namespace hl {

namespace {

// Clocks of two machines go apart by less than that, s in a second.
constexpr double kDrift = 1e-4;

}  // namespace

RemoteJudge::RemoteJudge(const DeviceInfo& device, const TeleopSettings& settings)
    : device_(device), settings_(settings) {
  input_.on = true;
}

CommandVerdict RemoteJudge::judge(const HandCommand& command, std::int64_t now_ns) {
  const bool is_force = command.input == RosInput::kRemoteCf;
  if (!is_force && command.input != RosInput::kRemoteEnergy) return CommandVerdict::kMalformed;
  if (!vectorOf(command).allFinite()) return CommandVerdict::kNotANumber;
  if (command.own_frame != 1) return CommandVerdict::kOtherFrame;
  const std::int64_t age_ns = waited_ns(command, now_ns, 2 * kRemoteLife_ns);
  if (age_ns >= 2 * kRemoteLife_ns) return CommandVerdict::kStale;
  Sender& sender = senders_[is_force ? 0 : 1];
  const bool anew = sender.last_ns == 0 || sender.writer != command.writer;
  const double since_ns = static_cast<double>(command.arrived_ns) - static_cast<double>(sender.last_ns);
  const double least_ns = static_cast<double>(sender.least_age_ns) + kDrift * std::max(0.0, since_ns);
  sender.writer = command.writer;
  sender.least_age_ns =
      anew ? command.age_ns : std::min(command.age_ns, static_cast<std::int64_t>(std::clamp(least_ns, -9e18, 9e18)));
  const double late_ns = static_cast<double>(command.age_ns) - static_cast<double>(sender.least_age_ns);
  if (is_force && late_ns > 1e9 * settings_.max_age_s) return CommandVerdict::kStale;
  if (is_force) {
    input_.force_N = cutTo(settings_.force_scale * vectorOf(command), device_.force_max_N);
    input_.fresh_until_ns = command.arrived_ns + kRemoteLife_ns;
  } else {
    takeTotal(sender, command.value[0], command.arrived_ns, anew);
  }
  sender.last_ns = command.arrived_ns;
  return CommandVerdict::kTaken;
}

void RemoteJudge::takeTotal(Sender& sender, double total_J, std::int64_t arrived_ns, bool anew) {
  const double grown_J = anew ? 0 : std::max(0.0, total_J - sender.total_J);
  const double since_s = seconds(arrived_ns - sender.last_ns);
  const double most_J = anew ? 0 : std::max(0.0, since_s) * device_.force_max_N * device_.velocity_max_m_s;
  input_.given_up_J += std::min(settings_.jouleScale() * grown_J, most_J);
  sender.total_J = anew ? total_J : std::max(sender.total_J, total_J);
}

}  // namespace hl
