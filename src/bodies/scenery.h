// Scenery: what bodies meet that is none, while its client moves it. Within a step it goes from where it is at the
// begin to where it is at the end, whatever is in its way.
#pragma once

#include <cstdint>
#include <limits>

#include "scene/snapshot.h"

namespace hl {

/// Of the motions of the scene, monotonic; by itself: when all of them are over.
struct StepTimes {
  std::int64_t begin_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t end_ns = std::numeric_limits<std::int64_t>::max();
};

/// m/s, of the instance's point that is at `point` (world) at the begin of a step of `period_s` (> 0), on the straight
/// line to where it is at its end. What bends it does not count. RT-safe.
Vec3 sceneryVelocity(const Instance& instance, const StepTimes& times, double period_s, const Vec3& point);

/// m/s: no point of an instance is ever faster. Walks over all of them.
double fastestScenery_m_s(const Snapshot& scene);

}  // namespace hl
