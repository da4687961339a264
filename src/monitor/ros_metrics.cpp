#include "monitor/ros_metrics.h"

#include <utility>

namespace hl {

namespace {

constexpr std::array<const char*, kRosInputs> kInputNames{"servo_cf", "servo_cp", "remote_cf", "remote_energy_in"};
// Of what is refused.
constexpr std::array<const char*, static_cast<std::size_t>(CommandVerdict::kVerdicts)> kReasonNames{
    "", "malformed", "not_a_number", "other_frame", "stale"};

void writeTeleop(MetricsText& out, const TeleopView& teleop) {
  using enum MetricType;
  const HLteleopPort& energy = teleop.port.energy;
  out.single("hl_teleop_engaged", kGauge, "1 while the hand leads the robot", teleop.engaged ? 1 : 0);
  out.single("hl_teleop_tank_joules", kGauge, "What the robot's force may still give the hand", energy.tank_J);
  out.family("hl_teleop_joules_total", kCounter, "Energy between hand and robot, at the hand");
  out.sample(energy.put_in_J, {{"what", "put_in"}});
  out.sample(energy.given_J, {{"what", "given"}});
  out.sample(energy.sent_J, {{"what", "sent"}});
  out.sample(energy.received_J, {{"what", "received"}});
  out.sample(energy.forgotten_J, {{"what", "forgotten"}});
  out.single("hl_teleop_withheld_joules", kGauge, "Work of the robot's force, less that of what was felt of it",
             teleop.port.withheld_J);
}

}  // namespace

void writeRosMetrics(MetricsText& out, const RosCounts& counts) {
  using enum MetricType;
  out.single("hl_ros_running", kGauge, "1 while hl-ros serves topics of ROS 2", counts.running ? 1 : 0);
  out.single("hl_ros_states_total", kCounter, "States of hands told, each a sample of every measured topic",
             static_cast<double>(counts.states));
  out.single("hl_ros_states_lost_total", kCounter, "States left out, as hl-ros was behind",
             static_cast<double>(counts.states_lost));
  out.family("hl_ros_commands_total", kCounter, "Samples that came for hands");
  for (std::size_t i = 0; i < kInputNames.size(); ++i)
    out.sample(static_cast<double>(counts.received[i]), {{"topic", kInputNames[i]}});
  out.family("hl_ros_refused_total", kCounter, "Of those the ones left out");
  for (std::size_t i = 1; i < kReasonNames.size(); ++i)
    out.sample(static_cast<double>(counts.verdicts[i]), {{"reason", kReasonNames[i]}});
  out.single("hl_ros_ends_total", kCounter, "Times that a hand was let go, as no other command came in time",
             static_cast<double>(counts.ends));
  out.single("hl_ros_starts_total", kCounter, "Times that hl-ros was started again, after it had ended",
             static_cast<double>(counts.starts));
  if (counts.teleop) writeTeleop(out, *counts.teleop);
}

MonitorCallbacks withRosMetrics(MonitorCallbacks monitor, const RosBridge* bridge) {
  if (bridge == nullptr) return monitor;
  monitor.metrics = [own = std::move(monitor.metrics), bridge](MetricsText& out) {
    own(out);
    writeRosMetrics(out, bridge->counts());
  };
  return monitor;
}

}  // namespace hl
