// PlacedConvex: a convex shape at a pose in the world.
#pragma once

#include <span>

#include "bodies/convex.h"

namespace hl {

/// A convex shape in the world; all that it refers to must outlive it.
struct PlacedConvex {
  const Convex* shape = nullptr;     ///< topology and radius
  std::span<const Vec3> vertices{};  ///< m, world
  std::span<const Vec3> normals{};   ///< of the faces, world
  Vec3 centre = Vec3::Zero();        ///< m, world: inside the shape
  bool turned_edge = false;          ///< a cylinder whose edge of vertices 0 and 1 is turned toward the other shape
};

/// A cylinder: its vertices are those of a prism, whose sides lie inside it.
inline bool isRound(const PlacedConvex& of) { return of.shape->round_radius > 0; }

/// Room for one placed shape on the stack.
struct PlacedRoom {
  std::array<Vec3, kMaxVertices> vertices;
  std::array<Vec3, kMaxFaces> normals;
};

}  // namespace hl
