// HandMotion: where a hand is, how fast it moves and what it feels, from the last steps of its servo.
#pragma once

#include <cstdint>
#include <optional>

#include "base/log_ring.h"
#include "base/vec.h"
#include "ros/packets.h"
#include "touch/touch_views.h"

namespace hl {

/// Frame D.
struct HandMotion {
  ServoMoment newest;
  Vec3 velocity_m_s = Vec3::Zero();
};

/// The slope of the line nearest to the finger's places (least squares) over kSlope_ns before the newest one: encoders
/// of 30 um at 1 kHz are 5 mm/s of noise so, and 30 mm/s from one step to the next. It is late by half of that time.
inline constexpr std::int64_t kSlope_ns = 10'000'000;

/// Nothing: the servo makes no steps, or the device does not answer. Any thread but the loops'.
std::optional<HandMotion> newestMotion(const LogRing<ServoMoment>& moments);

/// `to_system_ns`: the system clock less the monotonic one.
RosHandState stateOf(std::uint32_t hand, const HandMotion& motion, bool has_gripper, std::int64_t to_system_ns);

}  // namespace hl
