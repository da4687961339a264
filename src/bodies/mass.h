// Mass: mass, centre of mass and inertia of a rigid body.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/vec.h"
#include "bodies/convex.h"
#include "geometry/box.h"

namespace hl {

/// Object frame. The inertia is about the centre of mass; symmetric and positive definite.
struct Mass {
  double mass_kg = 1;
  Vec3 centre_O = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Identity();
};

/// Of uniform density, centred at the origin of the object. All arguments > 0.
Mass massOfBall(double mass_kg, double radius_m);
/// `half_m`: half of the sides, each > 0.
Mass massOfBox(double mass_kg, const Vec3& half_m);
/// Along z: a cylinder of this half length, with half a ball at each end.
Mass massOfCapsule(double mass_kg, double half_length_m, double radius_m);
/// Along z.
Mass massOfCylinder(double mass_kg, double half_length_m, double radius_m);

/// A body of density 1 kg/m^3: its mass is its volume.
struct Solid {
  double volume_m3 = 0;
  Vec3 centre_O = Vec3::Zero();        ///< m
  Mat3 inertia_m5 = Mat3::Identity();  ///< about the centre
};
/// What a closed mesh holds, by exact integrals over tetrahedra. Its triangles may all face inward. Throws Error, with
/// what to do, if the mesh is open or holds nothing.
Solid solidOf(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);
/// Of a polyhedron with faces, without its radius, in the frame of its vertices.
Solid solidOf(const Convex& polyhedron);
/// What a mesh is made of as a shell of this thickness (m, > 0), half of it on both sides: its area times the
/// thickness. Where triangles meet, their ends overlap or gape by a part of the thickness. It may be open; its
/// triangles may face either way. Throws Error if it has no area.
Solid solidOfSheet(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                   double thickness_m);
/// Of several, at least one, as one body. Where they overlap, it is as dense as both.
Solid sumOf(std::span<const Solid> solids);
/// Whether matter within these bounds can have such moments. Not those of a mesh that crosses itself: what faces inward
/// there counts as less than nothing.
bool isMatterWithin(const Box& bounds, const Solid& solid);
/// Throws Error unless the density, kg/m^3, is > 0.
Mass massOfDensity(double density_kg_m3, const Solid& solid);

}  // namespace hl
