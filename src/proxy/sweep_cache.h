// SweepCache: a set of primitives that includes all within some distance of a position. A sweep visits all primitives
// that touch the proxy at its end, so the contacts there are found without another search of the hierarchy. If nothing
// moves, the next tick uses the same set. If triangles are large, a ball ahead of the proxy supplies them for several
// ticks (lookahead_ball.h). The closest points of the contacts at the proxy's position are kept too, as the next tick
// starts there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// Plain values; RT-safe. World frame.
class SweepCache {
 public:
  static constexpr std::size_t kRoom = cost::kSweepRoom;

  struct Measured {
    PrimitiveId primitive;
    ClosestPoint nearest;
  };

  /// Clears the set. The caller then adds all primitives within `distance` (m) of a position that it gives by endAt().
  void begin(const SceneAt& scene, double distance) {
    neighbours_.clear();
    room_left_ = true;
    place_known_ = measured_all_ = false;
    scene_ = scene.snapshot().identity;
    time_ns_ = scene.time_ns();
    distance_ = distance;
  }
  /// As begin(), for a position that is known: endAt() then has no effect.
  void beginAround(const SceneAt& scene, const Vec3& place, double distance) {
    begin(scene, distance);
    place_ = place;
    place_known_ = true;
  }
  void endAt(const Vec3& place) {
    if (!place_known_) place_ = place;
  }
  void add(PrimitiveId primitive) { push({primitive, Vec3::Zero(), 0}); }
  /// Adds a primitive whose closest point to some position is known. As it is convex, all of it lies behind the plane
  /// at that point.
  void add(PrimitiveId primitive, const ClosestPoint& nearest) {
    push({primitive, nearest.normal, nearest.normal.dot(nearest.point)});
  }
  void forget() { room_left_ = false; }
  std::size_t size() const { return neighbours_.size(); }
  /// Whether the set was begun by beginAround(); it may then cover other positions too.
  bool isBall() const { return place_known_; }

  /// Whether the set includes all primitives within `distance` of `place` in this scene. If two positions are covered,
  /// so is the segment between them.
  bool covers(const SceneAt& scene, const Vec3& place, double distance) const {
    const bool still =
        scene.time_ns() == time_ns_ || scene.snapshot().moves_until_ns <= std::min(time_ns_, scene.time_ns());
    const double slack = distance_ - distance;
    return room_left_ && scene_ == scene.snapshot().identity && still && slack >= 0 &&
           (place - place_).squaredNorm() <= slack * slack;
  }
  /// How far the proxy may move from the covered position `place` and still be covered for `distance`, m.
  double slack_m(const Vec3& place, double distance) const { return distance_ - distance - (place - place_).norm(); }
  /// Calls visit(primitive) for those that may come within `distance` of the segment between two covered positions.
  template <typename Visit>
  void forEach(const Vec3& from, const Vec3& to, double distance, const Visit& visit) const {
    for (const Neighbour& one : neighbours_) {
      const double least = std::min(one.normal.dot(from), one.normal.dot(to)) - one.offset;
      if (least <= distance) visit(one.primitive);
    }
  }

  /// Clears the closest points. The caller then adds those of all primitives within `distance` of `place`, which must
  /// be covered.
  void beginMeasured(const Vec3& place, double distance) {
    measured_.clear();
    measured_all_ = true;
    measured_at_ = place;
    measured_within_ = distance;
  }
  void addMeasured(PrimitiveId primitive, const ClosestPoint& nearest) {
    measured_all_ = measured_.push({primitive, nearest}) && measured_all_;
  }
  /// Whether measured() includes all primitives within `distance` of `place`, if the position is covered.
  bool hasMeasured(const Vec3& place, double distance) const {
    return measured_all_ && measured_at_ == place && measured_within_ == distance;
  }
  const auto& measured() const { return measured_; }

 private:
  struct Neighbour {
    PrimitiveId primitive;
    Vec3 normal;  // unit, or zero if unknown: all of the primitive lies at normal . x <= offset
    double offset;
  };

  void push(const Neighbour& one) { room_left_ = neighbours_.push(one) && room_left_; }

  bool room_left_ = false, place_known_ = false, measured_all_ = false;
  std::uint64_t scene_ = 0;  // 0 is the identity of no snapshot
  std::int64_t time_ns_ = 0;
  double distance_ = 0, measured_within_ = 0;
  Vec3 place_ = Vec3::Zero(), measured_at_ = Vec3::Zero();
  FixedVector<Neighbour, kRoom> neighbours_;
  FixedVector<Measured, cost::kMeasuredRoom> measured_;
};

}  // namespace hl
