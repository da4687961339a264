// PoseSource: who says where an object is at each moment: its client, by a motion from frame to frame (motion.h), or
// whatever else drives it.
#pragma once

#include <cstdint>
#include <limits>

#include "geometry/box.h"
#include "scene/pose.h"

namespace hl {

/// Immutable as far as it is seen: the same moment has the same bits, for every thread. World frame.
class PoseSource {
 public:
  /// restsFrom_ns() of one that never rests.
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  virtual ~PoseSource() = default;
  /// RT-safe.
  virtual Pose at(std::int64_t time_ns) const = 0;
  /// The latest moment in (now_ns, until_ns] up to which it turns by no more than `turn_rad` and its velocity does not
  /// jump: until then the proxy may be swept on a straight line in its frame. RT-safe.
  virtual std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const = 0;
  /// Whether it is at different places at different moments. RT-safe.
  virtual bool moves() const = 0;
  /// From then on it is at to(). RT-safe.
  virtual std::int64_t restsFrom_ns() const = 0;
  /// Where it comes to rest; of one that never rests, any of its places. RT-safe.
  virtual Pose to() const = 0;
  /// Holds all of an object with this box in its own frame, at every moment.
  virtual Box reach(const Box& object) const = 0;
};

}  // namespace hl
