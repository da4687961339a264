#include "device/hand_script.h"

#include <algorithm>

namespace hl {

namespace {

// Where a time lies: a part of the way between two samples, which may be the same.
struct Between {
  const HandScript::Sample& before;
  const HandScript::Sample& after;
  double part = 0;
};

Between around(const std::vector<HandScript::Sample>& samples, double time_s) {
  const auto next = std::upper_bound(samples.begin(), samples.end(), time_s,
                                     [](double t, const HandScript::Sample& sample) { return t < sample.time_s; });
  if (next == samples.begin()) return {samples.front(), samples.front()};
  if (next == samples.end()) return {samples.back(), samples.back()};
  const auto before = next - 1;
  return {*before, *next, (time_s - before->time_s) / (next->time_s - before->time_s)};
}

}  // namespace

Vec3 HandScript::at(double time_s) const {
  const Between at = around(samples, time_s);
  return at.before.position + at.part * (at.after.position - at.before.position);
}

std::optional<Eigen::Quaterniond> HandScript::turnedAt(double time_s) const {
  const Between at = around(samples, time_s);
  if (!at.before.turned || !at.after.turned) return std::nullopt;
  return at.before.turned->slerp(at.part, *at.after.turned);
}

std::optional<double> HandScript::gripperAt(double time_s) const {
  const Between at = around(samples, time_s);
  if (!at.before.gripper_rad || !at.after.gripper_rad) return std::nullopt;
  return *at.before.gripper_rad + at.part * (*at.after.gripper_rad - *at.before.gripper_rad);
}

}  // namespace hl
