// SceneAt: a snapshot at one moment, for the proxy's queries: nearby primitives and first impact, in the world frame. A
// query is passed to each object near the position, in its own frame, and the results are transformed back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/fixed_vector.h"
#include "base/function_ref.h"
#include "geometry/closest_point.h"
#include "geometry/sweep.h"
#include "scene/recent_primitives.h"
#include "scene/snapshot.h"

namespace hl {

/// Valid only when firstImpact returned true. World frame.
struct SceneImpact {
  Impact impact;
  PrimitiveId primitive;
};

/// Cost of the queries, the same on every machine. It depends on the hierarchies and caches.
struct QueryCost {
  std::size_t volumes = 0;     ///< bounding volumes visited
  std::size_t primitives = 0;  ///< primitives read, each for an exact test
};

/// A snapshot, which must outlive this object, and a time. Made for one tick, on one thread. RT-safe.
class SceneAt {
 public:
  SceneAt(const Snapshot& snapshot, std::int64_t time_ns = 0)  // NOLINT: implicit, as a snapshot at rest is a scene
      : snapshot_(snapshot), time_ns_(time_ns), recent_(own_.emplace()) {}
  /// With a cache of primitives read by earlier ticks of the same thread, which must outlive this object too.
  SceneAt(const Snapshot& snapshot, std::int64_t time_ns, RecentPrimitives& recent)
      : snapshot_(snapshot), time_ns_(time_ns), recent_(recent) {
    recent_.readFrom(snapshot.identity, std::min(time_ns, snapshot.deforms_until_ns));
  }
  /// The same scene and time without the objects of these keys, at most kMaxLeftOut that are in it. It adds to the
  /// cost of `of`, which must outlive it.
  SceneAt(const SceneAt& of, std::span<const std::uint64_t> left_out);
  /// The same objects at another time. It adds to the cost of `of`, which must outlive it.
  SceneAt(const SceneAt& of, std::int64_t time_ns);
  SceneAt(const SceneAt&) = delete;
  SceneAt& operator=(const SceneAt&) = delete;

  static constexpr std::size_t kMaxLeftOut = 4;

  const Snapshot& snapshot() const { return snapshot_; }
  std::int64_t time_ns() const { return time_ns_; }
  double extent() const { return snapshot_.extent; }
  /// Total of all queries so far.
  const QueryCost& cost() const { return cost_; }
  /// One more exact test, that was made beside the queries.
  void countTest() const { ++cost_.primitives; }

  /// Whether it has no part in the queries, by its number.
  bool leavesOut(std::uint32_t instance) const {
    return std::find(left_out_.begin(), left_out_.end(), instance) != left_out_.end();
  }
  const Instance& instance(PrimitiveId id) const { return snapshot_.instances[id.instance]; }
  /// The shape that numbers the primitives of the instance at this time.
  const Shape& shape(PrimitiveId id) const { return instance(id).shapeAt(time_ns_); }
  /// In the frame of its object; valid until the next call.
  const Primitive& primitive(PrimitiveId id) const {
    ++cost_.primitives;
    return recent_.get(id, [&] { return read(id); });
  }
  PrimitiveKind kind(PrimitiveId id) const {
    return instance(id).transitionAt(time_ns_) ? primitive(id).kind : instance(id).shape->kind(id.element);
  }
  Vec3 turnToObject(PrimitiveId id, const Vec3& v_W) const;
  Vec3 turnToWorld(PrimitiveId id, const Vec3& v_O) const;

  /// As closestPoint() and closestPointWithin() of geometry/closest_point.h, in the world frame.
  ClosestPoint closest(PrimitiveId id, const Vec3& p) const;
  bool closestWithin(PrimitiveId id, const Vec3& p, double distance, ClosestPoint& out) const;
  /// Unit direction of the edge that `feature` names, or of a segment; world frame.
  Vec3 edge(PrimitiveId id, Feature feature) const;
  /// Whether `a` comes before `b`: by their positions, and for copies by their properties; never by their order in the
  /// input.
  bool precedes(PrimitiveId a, PrimitiveId b) const;

  /// Visits every primitive within `distance` (m, inclusive) of `centre`, in no given order, possibly more than once.
  void primitivesWithin(const Vec3& centre, double distance,
                        FunctionRef<void(PrimitiveId primitive, const ClosestPoint& nearest)> visit) const;
  /// The same if there are at most `most`; with more it visits that many of them, and returns false. One that is
  /// visited more than once counts as often.
  bool fewWithin(const Vec3& centre, double distance, std::size_t most,
                 FunctionRef<void(PrimitiveId primitive, const ClosestPoint& nearest)> visit) const;
  /// The primitive nearest to `point`, at any distance; of several precedes() decides. False: the scene is empty, and
  /// the rest is unchanged.
  bool nearest(const Vec3& point, PrimitiveId& primitive, ClosestPoint& at) const;
  /// As firstImpact() of geometry/queries.h; `contacts` are all primitives for which is_contact is true.
  bool firstImpact(const Vec3& from, const Vec3& motion, double radius, double touching, SceneImpact& out) const;
  bool firstImpact(const Vec3& from, const Vec3& motion, double radius,
                   FunctionRef<bool(const ClosestPoint& start)> is_contact, SceneImpact& out) const;
  bool firstImpact(const Vec3& from, const Vec3& motion, double radius, double touching, double soon,
                   std::span<const PrimitiveId> contacts, FunctionRef<void(PrimitiveId primitive)> meet,
                   SceneImpact& out) const;
  /// As firstImpact(), among the given primitives only. None is a contact: all are farther than `radius` from `from`.
  bool firstImpactAmong(std::span<const PrimitiveId> primitives, const Vec3& from, const Vec3& motion, double radius,
                        SceneImpact& out) const;

 private:
  Primitive read(PrimitiveId id) const;
  template <typename Search, typename Visit>
  void searchNear(const Vec3& centre, double distance, const Search& search, const Visit& visit_one) const;
  template <typename Ask>
  bool firstOf(const Vec3& from, const Vec3& motion, double distance, const Ask& ask, SceneImpact& out) const;

  const Snapshot& snapshot_;
  std::int64_t time_ns_;
  std::optional<FewRecentPrimitives> own_;
  RecentPrimitives& recent_;
  FixedVector<std::uint32_t, kMaxLeftOut> left_out_;  // numbers of instances
  mutable QueryCost own_cost_;
  QueryCost& cost_ = own_cost_;
};

}  // namespace hl
