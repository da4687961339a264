#include "bodies/convex.h"

namespace hl {

Convex ballShape(double radius) {
  Convex shape;
  shape.vertices = {Vec3::Zero()};
  shape.radius = shape.reach = radius;
  return shape;
}

Convex capsuleShape(double half_length, double radius) {
  Convex shape;
  shape.vertices = {half_length * Vec3::UnitZ(), -half_length * Vec3::UnitZ()};
  shape.edges = {{0, 1, 0}};
  shape.directions = {{0, 1}};
  shape.radius = radius;
  shape.reach = half_length + radius;
  return shape;
}

// Vertex i has the sign of bit 0 of i in x, of bit 1 in y, of bit 2 in z.
Convex boxShape(const Vec3& half) {
  Convex shape;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    shape.vertices.push_back(half.cwiseProduct(sign));
  }
  shape.edges = {{0, 1, 0}, {2, 3, 0}, {4, 5, 0}, {6, 7, 0}, {0, 2, 1}, {1, 3, 1},
                 {4, 6, 1}, {5, 7, 1}, {0, 4, 2}, {1, 5, 2}, {2, 6, 2}, {3, 7, 2}};
  shape.directions = {{0, 1}, {0, 2}, {0, 4}};
  shape.faces = {{-Vec3::UnitX(), {0, 4, 6, 2}}, {Vec3::UnitX(), {1, 3, 7, 5}},  {-Vec3::UnitY(), {0, 1, 5, 4}},
                 {Vec3::UnitY(), {2, 6, 7, 3}},  {-Vec3::UnitZ(), {0, 2, 3, 1}}, {Vec3::UnitZ(), {4, 5, 7, 6}}};
  shape.reach = half.norm();
  return shape;
}

Convex triangleTopology() {
  Convex shape;
  shape.vertices.resize(3, Vec3::Zero());
  shape.edges = {{0, 1, 0}, {1, 2, 1}, {2, 0, 2}};
  shape.directions = {{0, 1}, {1, 2}, {2, 0}};
  shape.faces = {{Vec3::UnitZ(), {0, 1, 2}}, {-Vec3::UnitZ(), {0, 2, 1}}};
  return shape;
}

}  // namespace hl
