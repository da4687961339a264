// Bend: how a mesh gets from one shape to the next. Each vertex goes on a straight line at constant speed, so
// between two frames of its client a mesh that deforms is in one place at every moment, as an object that moves is
// (motion.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "geometry/moving_bvh.h"
#include "scene/shape.h"

namespace hl {

/// One way between two shapes of one mesh, which number their primitives alike and have one tree. Immutable; any
/// thread.
class MeshTransition {
 public:
  /// `begin_ns` < `end_ns`. Where the shapes do not fit together (other elements have shrunk to nothing in one than in
  /// the other, or the hierarchies were built apart) copies are made that do; then what has shrunk to a line or a point
  /// is that, and a vertex that comes from beyond reach is at its end from the beginning. Copies are counted against
  /// `memory`; throws hl::Error when there is no room for them. Allocates.
  MeshTransition(std::shared_ptr<const Shape> from, std::shared_ptr<const Shape> to, std::int64_t begin_ns,
                 std::int64_t end_ns, const MemoryBudget& memory = {});

  const std::shared_ptr<const Shape>& from() const { return from_; }
  const std::shared_ptr<const Shape>& to() const { return to_; }
  /// What from() and to() were made from, or they themselves.
  const std::shared_ptr<const Shape>& given_from() const { return given_from_; }
  const std::shared_ptr<const Shape>& given_to() const { return given_to_; }
  std::int64_t begin_ns() const { return begin_ns_; }
  std::int64_t end_ns() const { return end_ns_; }
  /// Of the way, 0..1. RT-safe, as all below.
  double part(std::int64_t time_ns) const;
  /// Of a primitive of to(), in the order given.
  std::array<Vec3, 3> corners(ElementId primitive, double part) const;
  Primitive primitive(ElementId primitive, double part) const;
  /// How far its fastest corner moves in all, m.
  double length_m(ElementId primitive) const;
  MovingBvh index(double begin, double end) const { return {*from_tree_, *to_tree_, begin, end}; }

 private:
  std::shared_ptr<const Shape> given_from_, given_to_, from_, to_;
  const WideBvh *from_tree_, *to_tree_;
  std::int64_t begin_ns_, end_ns_;
};

/// One way, or one that follows another. Immutable; any thread.
class MeshMotion {
 public:
  /// Stays at last.from() until `last` begins.
  explicit MeshMotion(MeshTransition last) : last_(std::move(last)) {}
  /// This one, and then to `to` at about `end_ns` > `begin_ns`: a way that has begun by `begin_ns` is gone to its end
  /// first, one that has not is forgotten. Counted as a way is.
  MeshMotion then(const std::shared_ptr<const Shape>& to, std::int64_t begin_ns, std::int64_t end_ns,
                  const MemoryBudget& memory = {}) const;

  std::int64_t end_ns() const { return last_.end_ns(); }
  const std::optional<MeshTransition>& earlier() const { return earlier_; }
  const MeshTransition& last() const { return last_; }
  const MeshTransition& at(std::int64_t time_ns) const {
    return earlier_ && time_ns < last_.begin_ns() ? *earlier_ : last_;
  }
  /// As two that say so of themselves.
  MeshMotion(std::optional<MeshTransition> earlier, MeshTransition last)
      : earlier_(std::move(earlier)), last_(std::move(last)) {}
  /// Calls visit(shape) for each shape that is kept for it.
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
