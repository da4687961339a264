// SweepCache: a superset of the primitives within some distance of a place. A sweep meets all primitives that touch the
// proxy where it ends, so the contacts there need no other search; if nothing has moved since, neither does the next
// tick. Where triangles are large, the cache holds those of a ball ahead of the proxy (lookahead_ball.h). The closest
// points of the present contacts are kept too, as the next tick begins there.
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

  /// Begins anew: all primitives within `distance` (m) of the place that endAt() gives will be added.
  void begin(const SceneAt& scene, double distance) {
    neighbours_.clear();
    room_left_ = true;
    place_known_ = measured_all_ = false;
    scene_ = scene.snapshot().identity;
    time_ns_ = scene.time_ns();
    distance_ = distance;
  }
  /// The same of a place that is known: endAt() changes nothing.
  void beginAround(const SceneAt& scene, const Vec3& place, double distance) {
    begin(scene, distance);
    place_ = place;
    place_known_ = true;
  }
  void endAt(const Vec3& place) {
    if (!place_known_) place_ = place;
  }
  void add(PrimitiveId primitive) { push({primitive, Vec3::Zero(), 0}); }
  /// The same of one whose point nearest to some place is known: as it is convex, all of it lies behind the plane
  /// there.
  void add(PrimitiveId primitive, const ClosestPoint& nearest) {
    push({primitive, nearest.normal, nearest.normal.dot(nearest.point)});
  }
  void forget() { room_left_ = false; }
  std::size_t size() const { return neighbours_.size(); }
  /// Begun around a place: it may cover others too.
  bool isBall() const { return place_known_; }

  /// Whether all that are within `distance` of `place` in this scene have been added; where two places are covered, so
  /// is the way between them.
  bool covers(const SceneAt& scene, const Vec3& place, double distance) const {
    const bool still =
        scene.time_ns() == time_ns_ || scene.snapshot().moves_until_ns <= std::min(time_ns_, scene.time_ns());
    const double slack = distance_ - distance;
    return room_left_ && scene_ == scene.snapshot().identity && still && slack >= 0 &&
           (place - place_).squaredNorm() <= slack * slack;
  }
  /// How far from `place`, which is covered, everything else is, m.
  double slack_m(const Vec3& place, double distance) const { return distance_ - distance - (place - place_).norm(); }
  /// Calls visit(primitive) for those that may come within `distance` of the way between two places that are covered.
  template <typename Visit>
  void forEach(const Vec3& from, const Vec3& to, double distance, const Visit& visit) const {
    for (const Neighbour& one : neighbours_) {
      const double least = std::min(one.normal.dot(from), one.normal.dot(to)) - one.offset;
      if (least <= distance) visit(one.primitive);
    }
  }

  /// Begins anew with what touches: all within `distance` of `place`, which must be covered, are going to be measured.
  void beginMeasured(const Vec3& place, double distance) {
    measured_.clear();
    measured_all_ = true;
    measured_at_ = place;
    measured_within_ = distance;
  }
  void addMeasured(PrimitiveId primitive, const ClosestPoint& nearest) {
    measured_all_ = measured_.push({primitive, nearest}) && measured_all_;
  }
  /// Whether measured() holds all that touches there, if the place is covered.
  bool hasMeasured(const Vec3& place, double distance) const {
    return measured_all_ && measured_at_ == place && measured_within_ == distance;
  }
  const auto& measured() const { return measured_; }

 private:
  struct Neighbour {
    PrimitiveId primitive;
    Vec3 normal;  // unit, or zero where nothing is known: all of it lies at normal . x <= offset
    double offset;
  };

  void push(const Neighbour& one) { room_left_ = neighbours_.push(one) && room_left_; }

  bool room_left_ = false, place_known_ = false, measured_all_ = false;
  std::uint64_t scene_ = 0;  // no snapshot's identity
  std::int64_t time_ns_ = 0;
  double distance_ = 0, measured_within_ = 0;
  Vec3 place_ = Vec3::Zero(), measured_at_ = Vec3::Zero();
  FixedVector<Neighbour, kRoom> neighbours_;
  FixedVector<Measured, cost::kMeasuredRoom> measured_;
};

}  // namespace hl
