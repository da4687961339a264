// MeshMotion: how a mesh deforms from one shape to the next. Each vertex moves on a straight line at constant speed. So
// between two frames of its client the mesh is defined at every moment, like the pose of a moving object (motion.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "geometry/moving_bvh.h"
#include "scene/shape.h"

namespace hl {

/// A transition between two shapes of one mesh. The shapes number their primitives alike and have the same tree.
/// Immutable; any thread.
class MeshTransition {
 public:
  /// `begin_ns` < `end_ns`. Copies are made if the shapes do not match: if different elements are degenerate in them,
  /// or if their hierarchies were built separately. In the copies, an element that has shrunk to a line or a point is a
  /// segment or a point, and a vertex beyond reach is at its end position from the start. The copies are counted in
  /// `memory`; throws hl::Error if there is no room. Allocates.
  MeshTransition(std::shared_ptr<const Shape> from, std::shared_ptr<const Shape> to, std::int64_t begin_ns,
                 std::int64_t end_ns, const MemoryBudget& memory = {});

  const std::shared_ptr<const Shape>& from() const { return from_; }
  const std::shared_ptr<const Shape>& to() const { return to_; }
  /// The shapes given to the constructor; from() and to() are these or copies of them.
  const std::shared_ptr<const Shape>& given_from() const { return given_from_; }
  const std::shared_ptr<const Shape>& given_to() const { return given_to_; }
  std::int64_t begin_ns() const { return begin_ns_; }
  std::int64_t end_ns() const { return end_ns_; }
  /// Fraction of the transition, 0..1. RT-safe, like the functions below.
  double part(std::int64_t time_ns) const;
  /// Vertices of a primitive of to(), in the given order.
  std::array<Vec3, 3> corners(ElementId primitive, double part) const;
  Primitive primitive(ElementId primitive, double part) const;
  /// Length of the path of its fastest vertex, m.
  double length_m(ElementId primitive) const;
  MovingBvh index(double begin, double end) const { return {*from_tree_, *to_tree_, begin, end}; }

 private:
  std::shared_ptr<const Shape> given_from_, given_to_, from_, to_;
  const WideBvh *from_tree_, *to_tree_;
  std::int64_t begin_ns_, end_ns_;
};

/// One transition, or two in succession. Immutable; any thread.
class MeshMotion {
 public:
  /// The mesh is last.from() until `last` begins.
  explicit MeshMotion(MeshTransition last) : last_(std::move(last)) {}
  /// This motion, and then a transition to `to` that ends at about `end_ns` > `begin_ns`. A transition that has begun
  /// by `begin_ns` is completed first; one that has not is dropped. Memory is counted as for a transition.
  MeshMotion then(const std::shared_ptr<const Shape>& to, std::int64_t begin_ns, std::int64_t end_ns,
                  const MemoryBudget& memory = {}) const;

  std::int64_t end_ns() const { return last_.end_ns(); }
  const std::optional<MeshTransition>& earlier() const { return earlier_; }
  const MeshTransition& last() const { return last_; }
  const MeshTransition& at(std::int64_t time_ns) const {
    return earlier_ && time_ns < last_.begin_ns() ? *earlier_ : last_;
  }
  /// From two transitions, as returned by earlier() and last().
  MeshMotion(std::optional<MeshTransition> earlier, MeshTransition last)
      : earlier_(std::move(earlier)), last_(std::move(last)) {}
  /// Calls visit(shape) for each shape that the motion keeps.
  template <typename Visit>
  void forEachShape(const Visit& visit) const {
    for (const MeshTransition* way : {earlier_ ? &*earlier_ : nullptr, &last_}) {
      if (way == nullptr) continue;
      for (const auto* shape : {&way->given_from(), &way->given_to(), &way->from(), &way->to()}) visit(*shape);
    }
  }

 private:
  std::optional<MeshTransition> earlier_;
  MeshTransition last_;
};

}  // namespace hl
