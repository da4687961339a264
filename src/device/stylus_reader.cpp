#include "device/stylus_reader.h"

#include <cmath>

#include "base/clock.h"
#include "base/turn.h"

namespace hl {

Stylus StylusReader::read(const Stylus& reported, std::int64_t now_ns) {
  Stylus now = last_;
  Eigen::Quaterniond turned = reported.turned;
  if (toUnit(turned)) now.turned = turned;
  if (std::isfinite(reported.gripper_rad)) now.gripper_rad = reported.gripper_rad;
  if (std::isfinite(reported.gripper_N)) now.gripper_N = reported.gripper_N;
  const double elapsed_s = last_ns_ ? seconds(now_ns - *last_ns_) : 0;
  if (elapsed_s > 0) {
    const Vec3 spin_rad_s = rotationVector(now.turned * last_.turned.conjugate()) / elapsed_s;
    const double part = elapsed_s / (elapsed_s + kSpinFilter_s);
    now.spin_rad_s += part * (spin_rad_s - now.spin_rad_s);
  }
  last_ = now;
  last_ns_ = now_ns;
  return now;
}

}  // namespace hl
