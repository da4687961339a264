// Body command: what a client does to a body, and how it comes to the loop that steps the bodies.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "base/fixed_vector.h"
#include "base/spsc_ring.h"
#include "scene/pose.h"

namespace hl {

/// World frame. What is absent stays as it is.
struct BodyCommand {
  std::uint64_t key = 0;             ///< of the body; one that is not there is left alone
  std::optional<Vec3> position_m;    ///< of the object frame
  std::optional<Mat3> rotation;      ///< of the object frame
  std::optional<Vec3> velocity_m_s;  ///< of the centre of mass
  std::optional<Vec3> spin_rad_s;    ///< about it
  Vec3 impulse_N_s = Vec3::Zero();   ///< after that
  std::optional<Vec3> point_m;       ///< where it acts; absent: at the centre of mass
  double duration_s = 0;             ///< in which it is given evenly, >= 0; 0: at once
};

/// Those of one tick; more wait for the next.
using BodyCommands = FixedVector<BodyCommand, 4>;

/// An impulse that is given over time.
struct BodyPush {
  std::uint64_t key = 0;
  Vec3 point_O = Vec3::Zero();  ///< m, in the object frame
  Vec3 force_N = Vec3::Zero();
  double left_s = 0;
};
using BodyPushes = FixedVector<BodyPush, 64>;

class BodyCommandQueue {
 public:
  /// False: too many wait. Any thread but the loops.
  bool push(const BodyCommand& command) {
    const std::lock_guard lock(mutex_);
    return ring_.push(command);
  }
  /// By one loop at a time. RT-safe.
  void takeNext(BodyCommands& out) {
    out.clear();
    for (BodyCommand command; out.size() < BodyCommands::capacity() && ring_.pop(command);) out.push(command);
  }

 private:
  std::mutex mutex_;  // between those who push; the loops never see it
  SpscRing<BodyCommand, 1024> ring_;
};

}  // namespace hl
