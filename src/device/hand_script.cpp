#include "device/hand_script.h"

#include <algorithm>

namespace hl {

namespace {

// Times of a script increase strictly.
constexpr double kShortest_s = 1e-3;

auto firstAfter(const std::vector<HandScript::Sample>& samples, double time_s) {
  return std::upper_bound(samples.begin(), samples.end(), time_s,
                          [](double t, const HandScript::Sample& sample) { return t < sample.time_s; });
}

// Where a time lies: a part of the way between two samples, which may be the same.
struct Between {
  const HandScript::Sample& before;
  const HandScript::Sample& after;
  double part = 0;
};

Between around(const std::vector<HandScript::Sample>& samples, double time_s) {
  const auto next = firstAfter(samples, time_s);
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

bool HandScript::holdsAt(double time_s) const {
  const auto next = firstAfter(samples, time_s);
  return next == samples.begin() ? samples.front().holds : (next - 1)->holds;
}

PersonScript::PersonScript(const Vec3& start, double wait_s) {
  script_.samples.push_back({0, start});
  wait(wait_s);
}

PersonScript& PersonScript::moveTo(const Vec3& goal, double speed_m_s) {
  const double lasts_s = std::max(kShortest_s, (goal - place()).norm() / speed_m_s);
  script_.samples.push_back({duration_s() + lasts_s, goal});
  return *this;
}

PersonScript& PersonScript::wait(double duration_s) {
  script_.samples.push_back({this->duration_s() + std::max(kShortest_s, duration_s), place()});
  return *this;
}

PersonScript& PersonScript::press(const Vec3& way, double speed_m_s, double duration_s) {
  const Vec3 from = place();
  return moveTo(from + way, speed_m_s).wait(duration_s).moveTo(from, speed_m_s);
}

PersonScript& PersonScript::tap(const Vec3& way, double speed_m_s, int times) {
  for (int i = 0; i < times; ++i) press(way, speed_m_s, 0);
  return *this;
}

PersonScript& PersonScript::stroke(const Vec3& way, const Vec3& along, double speed_m_s) {
  const Vec3 from = place();
  return moveTo(from + way, speed_m_s)
      .moveTo(from + way + along, speed_m_s)
      .moveTo(from + way, speed_m_s)
      .moveTo(from, speed_m_s);
}

PersonScript& PersonScript::letGo(double duration_s) {
  script_.samples.back().holds = false;
  wait(duration_s);
  return *this;
}

}  // namespace hl
