#include "ros/hand_motion.h"

#include <algorithm>

#include "base/clock.h"
#include "base/fixed_vector.h"

namespace hl {

namespace {

// Of kSlope_ns at 6.4 kHz; of a faster servo the slope is over a shorter time.
constexpr std::size_t kMoments = 64;

using LastMoments = FixedVector<ServoMoment, kMoments>;

// The newest first, without gaps.
LastMoments lastMoments(const LogRing<ServoMoment>& moments) {
  LastMoments last;
  ServoMoment moment;
  for (std::uint64_t next = moments.pushed(); next > 0 && last.size() < kMoments; --next) {
    if (!moments.read(next - 1, moment) || moment.answered == 0) break;
    if (!last.empty() && last[0].time_ns - moment.time_ns > kSlope_ns) break;
    last.push(moment);
  }
  return last;
}

// Sum (t - mean t) (x - mean x) / sum (t - mean t)^2.
Vec3 slopeOf(const LastMoments& last) {
  double mean_s = 0;
  Vec3 mean = Vec3::Zero();
  const auto time_s = [&](const ServoMoment& moment) { return seconds(moment.time_ns - last[0].time_ns); };
  const double count = static_cast<double>(last.size());
  for (const ServoMoment& moment : last) {
    mean_s += time_s(moment) / count;
    mean += moment.finger_D / count;
  }
  double square_s2 = 0;
  Vec3 product = Vec3::Zero();
  for (const ServoMoment& moment : last) {
    const double t_s = time_s(moment) - mean_s;
    square_s2 += t_s * t_s;
    product += t_s * (moment.finger_D - mean);
  }
  return square_s2 > 0 ? Vec3(product / square_s2) : Vec3(Vec3::Zero());
}

std::array<double, 3> arrayOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::optional<HandMotion> newestMotion(const LogRing<ServoMoment>& moments) {
  const LastMoments last = lastMoments(moments);
  if (last.empty()) return std::nullopt;
  return HandMotion{last[0], slopeOf(last)};
}

RosHandState stateOf(std::uint32_t hand, const HandMotion& motion, bool has_gripper, std::int64_t to_system_ns) {
  const Stylus& stylus = motion.newest.stylus;
  RosHandState state;
  state.hand = hand;
  state.buttons = static_cast<std::uint32_t>(motion.newest.buttons);
  state.time_ns = motion.newest.time_ns + to_system_ns;
  state.position = arrayOf(motion.newest.finger_D);
  std::copy_n(stylus.turned.coeffs().data(), 4, state.orientation.begin());
  state.velocity = arrayOf(motion.velocity_m_s);
  state.angular_velocity = arrayOf(stylus.spin_rad_s);
  state.force = arrayOf(motion.newest.force_N);
  state.has_gripper = has_gripper ? 1 : 0;
  state.gripper_rad = stylus.gripper_rad;
  state.gripper_N = stylus.gripper_N;
  return state;
}

}  // namespace hl
