// TeleopSettings: how a hand leads a robot far away.
#pragma once

#include <cstdint>
#include <optional>

namespace hl {

struct TeleopSettings {
  double scale = 1;                                ///< way of the robot by that of the hand, above 0
  double force_scale = 1;                          ///< force on the hand by that on the robot, above 0
  std::optional<std::uint32_t> clutch_button = 0;  ///< the robot stays while it is down; none: it always follows
  double max_age_s = 0.5;                          ///< a force that was longer on the way is none

  /// Joules at the hand for a joule at the robot: a force times a way has the scales of both.
  double jouleScale() const { return force_scale / scale; }
};

}  // namespace hl
