// PoseSource: gives the pose of an object over time: a motion from frame to frame by its client (motion.h), or another
// driver.
#pragma once

#include <cstdint>
#include <limits>

#include "geometry/box.h"
#include "scene/pose.h"

namespace hl {

/// Logically immutable: the same time gives the same bits in every thread. World frame.
class PoseSource {
 public:
  /// restsFrom_ns() of an object that never rests.
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  virtual ~PoseSource() = default;
  /// RT-safe.
  virtual Pose at(std::int64_t time_ns) const = 0;
  /// The latest time in (now_ns, until_ns] up to which the object turns by at most `turn_rad` and its velocity does not
  /// jump. Until then the proxy may be swept on a straight line in the object's frame. RT-safe.
  virtual std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const = 0;
  /// Whether the pose changes over time. RT-safe.
  virtual bool moves() const = 0;
  /// From this time on the pose is to(). RT-safe.
  virtual std::int64_t restsFrom_ns() const = 0;
  /// The final pose; any of its poses for an object that never rests. RT-safe.
  virtual Pose to() const = 0;
  /// A box that contains an object at all times, from its box in its own frame.
  virtual Box reach(const Box& object) const = 0;
};

}  // namespace hl
