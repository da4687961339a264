#include "share/playout.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "scene/motion.h"

namespace hl {

ItemMotion motionOf(const Instance& instance, std::int64_t now_ns) {
  if (!instance.movesAsBody()) return {instance.shownAt(now_ns)};
  const ShownBody body = instance.body->poses->shown();
  return {body.pose, body.velocity_m_s, body.spin_rad_s};
}

void PlayoutDelay::add(std::int64_t transit_ns) {
  transits_[added_++ % kTransits] = std::max<std::int64_t>(transit_ns, 0);
  std::array<std::int64_t, kTransits> sorted = transits_;
  const std::size_t count = std::min(added_, kTransits);
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(sorted.begin(), end);
  const std::size_t late = count / 100;  // so many may come later
  delay_ns_ = std::min(sorted[count - 1 - late], sorted[0] + kMaxJitter_ns);
}

void SteadyLag::follow(std::int64_t now_ns, std::int64_t wanted_ns) {
  const std::int64_t passed_ns = std::max<std::int64_t>(0, now_ns - std::exchange(last_ns_, now_ns));
  if (!lag_ns_ || std::abs(wanted_ns - *lag_ns_) > kJump_ns) {
    lag_ns_ = wanted_ns;
    return;
  }
  const auto most_ns = static_cast<std::int64_t>(kRate * static_cast<double>(std::min(passed_ns, kJump_ns)));
  *lag_ns_ += std::clamp(wanted_ns - *lag_ns_, -most_ns, most_ns);
}

void Track::add(std::int64_t time_ns, const ItemMotion& motion) {
  const auto later =
      std::find_if(points_.begin(), points_.end(), [&](const Point& point) { return point.time_ns >= time_ns; });
  if (later != points_.end() && later->time_ns == time_ns) return;
  points_.insert(later, {time_ns, motion});
  if (points_.size() > kMaxPoints) points_.erase(points_.begin());
}

void Track::rest(std::int64_t time_ns, const ItemMotion& motion) {
  std::erase_if(points_, [&](const Point& point) { return point.time_ns >= time_ns; });
  points_.push_back({time_ns, motion});
}

Pose Track::at(std::int64_t time_ns) const {
  if (points_.empty()) return {};
  const auto after =
      std::find_if(points_.begin(), points_.end(), [&](const Point& point) { return point.time_ns > time_ns; });
  if (after == points_.begin()) return after->motion.pose;
  const Point& before = *(after - 1);
  if (after == points_.end() || before.time_ns == time_ns) return before.motion.pose;
  return Screw(before.motion.pose, after->motion.pose, before.time_ns, after->time_ns).at(time_ns);
}

void Track::forgetBefore(std::int64_t time_ns) {
  // The last one before stays: the object is between it and the next one.
  while (points_.size() > 1 && points_[1].time_ns <= time_ns) points_.erase(points_.begin());
}

}  // namespace hl
