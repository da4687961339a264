// Placed bodies: the shapes of all bodies in the world, at the begin of a step.
#pragma once

#include <vector>

#include "bodies/manifold.h"
#include "bodies/world.h"

namespace hl {

/// The shape in the world; the result refers to `body`, `vertices` and `normals`, which have room for it. RT-safe.
PlacedConvex placed(const Body& body, const BodyState& state, std::span<Vec3> vertices, std::span<Vec3> normals);
PlacedConvex placed(const Body& body, const BodyState& state, PlacedRoom& room);
/// A triangle, segment or point of the scene. RT-safe.
PlacedConvex placed(const Primitive& primitive, const Pose& pose, PlacedRoom& room);

/// By one thread at a time.
class PlacedBodies {
 public:
  explicit PlacedBodies(const World& world);
  /// RT-safe.
  void place(const World& world, const WorldState& state);
  const PlacedConvex& operator[](std::size_t body) const { return placed_[body]; }

 private:
  std::vector<Vec3> vertices_, normals_;
  std::vector<std::size_t> first_vertex_, first_normal_;
  std::vector<std::pair<Vec3, Eigen::Quaterniond>> poses_;  // at which each is placed
  std::vector<PlacedConvex> placed_;
};

}  // namespace hl
