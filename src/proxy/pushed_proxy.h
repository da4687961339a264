// PushedProxy: the proxy at one moment between two ticks, while moving objects push or carry it. It stands still or
// moves with its carrier: the object whose friction holds it, or the object that met it first.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

inline constexpr std::uint32_t kNoInstance = 0xffffffff;

/// World frame. The scene must outlive it; what it leaves out does not push. RT-safe.
struct PushedProxy {
  const Snapshot& snapshot() const { return at_end.snapshot(); }
  SceneAt scene() const { return {at_end, now_ns}; }
  /// Position of the proxy at `time_ns`, carried by its carrier from now on.
  Vec3 carriedTo(std::int64_t time_ns) const;
  /// Region around the way from the proxy to `way_end`. Objects outside it are not considered.
  Box regionOf(const Vec3& way_end) const;
  /// Calls visit(number, instance) for the objects whose region of motion (Snapshot::reach) meets regionOf(way_end).
  template <typename Visit>
  void forEachNear(const Vec3& way_end, const Visit& visit) const {
    const Box region = regionOf(way_end);
    snapshot().near.visitMet(region, [&](std::uint32_t i) {
      const Instance& instance = snapshot().instances[i];
      if (!at_end.leavesOut(i) && !instance.elsewhere(region)) visit(i, instance);
    });
  }

  std::int64_t end_ns() const { return at_end.time_ns(); }

  const SceneAt& at_end;  ///< at the time of the next tick
  const Tolerances tolerance;
  std::int64_t now_ns;
  Vec3 position;
  std::uint32_t carrier = kNoInstance;  ///< number of the instance; kNoInstance: none
};

/// The next advance of time: until `until_ns` nothing passes the proxy, which moves with its carrier.
struct Advance {
  std::int64_t until_ns = 0;
  std::uint32_t met = kNoInstance;  ///< the instance whose impact ends the advance
};

/// Number of the instance with this key, if it moves or deforms and is not left out; else kNoInstance.
std::uint32_t movingInstance(const SceneAt& scene, std::uint64_t key);

}  // namespace hl
