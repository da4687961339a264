// Placed bodies: the shapes of all bodies in the world.
#pragma once

#include <vector>

#include "bodies/manifold.h"
#include "bodies/world.h"

namespace hl {

/// A part of a body in the world; the result refers to `part`, `vertices` and `normals`, which have room. RT-safe.
PlacedConvex placed(const Convex& part, const BodyState& state, std::span<Vec3> vertices, std::span<Vec3> normals);
PlacedConvex placed(const Convex& part, const BodyState& state, PlacedRoom& room);
/// A triangle, segment or point of the scene. RT-safe.
PlacedConvex placed(const Primitive& primitive, const Pose& pose, PlacedRoom& room);

/// By one thread at a time.
class PlacedBodies {
 public:
  explicit PlacedBodies(const World& world);
  /// RT-safe.
  void place(const World& world, const WorldState& state);
  /// One of them alone. RT-safe.
  void place(const Body& body, std::size_t number, const BodyState& state);
  /// The parts of a body. RT-safe.
  std::span<const PlacedConvex> operator[](std::size_t body) const {
    return std::span(placed_).subspan(first_part_[body], first_part_[body + 1] - first_part_[body]);
  }

 private:
  std::vector<Vec3> vertices_, normals_;
  std::vector<std::size_t> first_part_;                     // of each body, and the number of all
  std::vector<std::size_t> first_vertex_, first_normal_;    // of each part
  std::vector<std::pair<Vec3, Eigen::Quaterniond>> poses_;  // at which each is placed
  std::vector<PlacedConvex> placed_;                        // each part
};

}  // namespace hl
