#include "control/remote_port.h"

#include <algorithm>

namespace hl {

namespace {

// A force F is bounded by the tank, F <= E / (w + h v), v the speed at which the hand gives way to it: the next step
// gives F v T, less than E. Without energy it ends as softly as over 0.5 mm or 5 ms, and a step of the encoders, 30 um
// or so, changes it by a few hundredths.
constexpr double kSoft_m = 0.5e-3, kSoft_s = 5e-3;
// Below a full tank the hand drags so much at the most, and what that takes fills it: otherwise the robot could never
// again lead a hand that moves to and fro in the open.
constexpr double kDrag_Ns_m = 5;

void followDeadline(RemotePort& port, const RemoteInput& input, const RemoteStep& step) {
  const bool counts = input.on && input.engaged && step.now_ns < input.fresh_until_ns;
  const double change = counts ? step.period_s / kRemoteRise_s : -step.period_s / kRemoteFade_s;
  port.part = std::clamp(port.part + change, 0.0, 1.0);
}

// Of the robot's force what the hand does not feel already.
Vec3 beyond(const Vec3& robot_N, const Vec3& local_N) {
  const double size_N = robot_N.norm();
  if (!(size_N > 0)) return Vec3::Zero();
  const double felt_N = std::max(0.0, local_N.dot(robot_N) / size_N);
  return std::max(0.0, 1 - felt_N / size_N) * robot_N;
}

Vec3 paidFor(const Vec3& force_N, double budget_J, const Vec3& velocity_m_s) {
  const double size_N = force_N.norm();
  if (!(size_N > 0)) return Vec3::Zero();
  const double yields_m_s = std::max(0.0, velocity_m_s.dot(force_N) / size_N);
  return limited(force_N, budget_J / (kSoft_m + kSoft_s * yields_m_s));
}

}  // namespace

Vec3 remoteForce(RemotePort& port, const RemoteInput& input, const RemoteStep& step) {
  const double work_J = port.held_N.dot(step.way);
  hlTeleopBook(&port.energy, work_J);
  port.withheld_J += port.asked_N.dot(step.way) - work_J;
  hlTeleopReceive(&port.energy, input.given_up_J);
  followDeadline(port, input, step);
  port.asked_N = input.force_N.allFinite() ? Vec3(port.part * beyond(input.force_N, step.local_N)) : Vec3(Vec3::Zero());
  const double budget_J = std::max(0.0, port.energy.tank_J - HL_TELEOP_RESERVE_J);
  const double lacking = std::clamp(1 - budget_J / (HL_TELEOP_TANK_J - HL_TELEOP_RESERVE_J), 0.0, 1.0);
  return paidFor(port.asked_N, budget_J, step.velocity_m_s) - port.part * lacking * kDrag_Ns_m * step.velocity_m_s;
}

void restRemote(RemotePort& port) {
  port.part = 0;
  port.held_N = port.asked_N = Vec3::Zero();
}

}  // namespace hl
