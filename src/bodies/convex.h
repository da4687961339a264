// Convex: the shape by which bodies collide: a convex polytope (a point, a segment, a polyhedron) grown by a radius. So
// balls, capsules, boxes and hulls are one kind, and a triangle of the scene is one too.
//
// A cylinder is a prism of 32 sides that does not turn about its axis with the body: where it meets something, one of
// its edges or sides is turned toward it (manifold.h). So a cylinder that lies, rolls, stands or tips on planes, and
// one that is touched at its side, is exact. Only where its rim crosses an edge, the normal errs by up to 6 degrees,
// and the place by up to 0.5 % of the radius.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace hl {

/// Immutable. Metres; frame of the body: origin at the centre of mass, axes of the object.
struct Convex {
  using Index = std::uint16_t;  ///< of a vertex
  struct Face {
    Vec3 normal;                 ///< unit, outward
    std::vector<Index> corners;  ///< counterclockwise, seen from outside
  };
  std::vector<Vec3> vertices;  ///< at least one
  struct Edge {
    Index begin, end;
    Index direction;  ///< number in `directions`
  };
  std::vector<Edge> edges;
  std::vector<std::array<Index, 2>> directions;  ///< of all edges, each once: from one vertex to the other
  std::vector<Face> faces;                       ///< none of a point or segment; a triangle has two
  double radius = 0;                             ///< m, >= 0
  double reach = 0;                              ///< m, greatest distance from `middle`
  double thin = 0;                               ///< m, half of the least width, radius included
  double round_radius = 0;                       ///< m; > 0: a cylinder about z; faces 0 and 1 are its ends
  Vec3 middle = Vec3::Zero();                    ///< inside; the origin but for a part of a compound
};

/// No shape has more: the work of a step is bounded.
inline constexpr std::size_t kMaxVertices = 64, kMaxFaces = 124;
/// Of the prism of a cylinder.
inline constexpr std::size_t kCylinderSides = 32, kCylinderEnds = 2;

/// Each argument > 0.
Convex ballShape(double radius);
Convex boxShape(const Vec3& half);
/// Along z, from -half_length to half_length, grown by the radius.
Convex capsuleShape(double half_length, double radius);
/// Along z, from -half_length to half_length.
Convex cylinderShape(double half_length, double radius);
/// Of faces that close it, each flat and counterclockwise from outside; the origin is inside.
Convex polyhedronShape(std::vector<Vec3> vertices, const std::vector<std::vector<Convex::Index>>& faces);
/// m: how far a point is above the face that it is farthest above; < 0 within. Of what has faces.
double heightAbove(const Convex& shape, const Vec3& point);
/// The shape with all of it moved by `way`: to the centre of mass, for a body.
Convex moved(Convex shape, const Vec3& way);
/// The shape as a part of a body whose origin may be outside of it. `middle`: inside.
Convex withMiddle(Convex shape, const Vec3& middle);
/// A two-sided triangle whose vertices are set later (PlacedConvex): faces 0 and 1 have opposite normals.
Convex triangleTopology();

}  // namespace hl
