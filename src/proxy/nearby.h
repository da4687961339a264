// Nearby: primitives among which are all that touch the proxy at one place. A sweep meets them on its way, so the
// contacts where it ends are found without asking the hierarchy again; and where nothing has moved since, neither does
// the next tick.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "scene/scene_at.h"

namespace hl {

/// Plain values; RT-safe. World frame.
class Nearby {
 public:
  /// A sweep over a million triangles, a quarter of the proxy's radius wide, meets three in the mean.
  static constexpr std::size_t kRoom = 24;

  /// Begins anew: all primitives within `distance` (m) of a place to be told by endAt() are going to be added.
  void begin(const SceneAt& scene, double distance) {
    primitives_.clear();
    room_left_ = true;
    scene_ = scene.snapshot().identity;
    time_ns_ = scene.time_ns();
    distance_ = distance;
  }
  void add(PrimitiveId primitive) { room_left_ = primitives_.push(primitive) && room_left_; }
  void forget() { room_left_ = false; }
  void endAt(const Vec3& place) { place_ = place; }

  /// Whether primitives() holds all that are within `distance` of `place` in this scene.
  bool covers(const SceneAt& scene, const Vec3& place, double distance) const {
    const bool still =
        scene.time_ns() == time_ns_ || scene.snapshot().moves_until_ns <= std::min(time_ns_, scene.time_ns());
    return room_left_ && scene_ == scene.snapshot().identity && still && place_ == place && distance_ == distance;
  }
  const auto& primitives() const { return primitives_; }

 private:
  FixedVector<PrimitiveId, kRoom> primitives_;
  bool room_left_ = false;
  std::uint64_t scene_ = 0;  // no snapshot's identity
  std::int64_t time_ns_ = 0;
  double distance_ = 0;
  Vec3 place_ = Vec3::Zero();
};

}  // namespace hl
