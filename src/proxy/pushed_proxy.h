// PushedProxy: the proxy at one moment between two ticks, while what moves pushes it or takes it along. It stands
// still, or goes with its carrier: the object whose friction holds it, or that has met it first.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

inline constexpr std::uint32_t kNoInstance = 0xffffffff;

/// World frame. The snapshot must outlive it. RT-safe.
struct PushedProxy {
  SceneAt scene() const { return {snapshot, now_ns}; }
  /// Where the carrier takes it by then.
  Vec3 carriedTo(std::int64_t time_ns) const;
  /// What comes nearer than this to the way of the proxy is looked at.
  Box regionOf(const Vec3& way_end) const;
  /// Calls visit(number, instance) for the objects whose reach comes near the way to `way_end`.
  template <typename Visit>
  void forEachNear(const Vec3& way_end, const Visit& visit) const {
    snapshot.near.visitMet(regionOf(way_end), [&](std::uint32_t i) { visit(i, snapshot.instances[i]); });
  }

  const Snapshot& snapshot;
  const Tolerances tolerance;
  const std::int64_t end_ns;  ///< of the next tick: until then things move
  std::int64_t now_ns;
  Vec3 position;
  std::uint32_t carrier = kNoInstance;  ///< number of the instance
};

/// How far time may go on at once: until then nothing passes the proxy, which goes where its carrier takes it.
struct Advance {
  std::int64_t until_ns = 0;
  std::uint32_t met = kNoInstance;  ///< the instance that ends it
};

/// The number of the object with this key, where it moves or deforms.
std::uint32_t movingInstance(const Snapshot& snapshot, std::uint64_t key);

}  // namespace hl
