#include "bodies/mesh_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/mesh_parts.h"
#include "geometry/primitive.h"

namespace hl {

namespace {

// kg; beyond them squares of numbers in a step are no longer exact enough.
constexpr double kMinMass_kg = 1e-9, kMaxMass_kg = 1e15;

// A shape along an axis of the object: 0, 1 or 2.
struct Bar {
  int axis = 2;
  double half_length = 0, radius = 0;  // m; of a capsule without its caps
};

Bar barOf(const Vec3& half, bool caps) {
  Bar bar;
  half.maxCoeff(&bar.axis);
  bar.radius = std::max(half[(bar.axis + 1) % 3], half[(bar.axis + 2) % 3]);
  bar.half_length = half[bar.axis] - (caps ? bar.radius : 0);
  return bar;
}

// Axes x, y, z of the shape to those of the object, so that its z lies along `axis`; a rotation.
Mat3 turnTo(int axis) {
  Mat3 turn = Mat3::Zero();
  turn((axis + 1) % 3, 0) = turn((axis + 2) % 3, 1) = turn(axis, 2) = 1;
  return turn;
}

void setTurned(Convex shape, const Mat3& by, Body& body) {
  for (Vec3& vertex : shape.vertices) vertex = by * vertex;
  for (Convex::Face& face : shape.faces) face.normal = by * face.normal;
  body.mass.inertia_kg_m2 = by * body.mass.inertia_kg_m2 * by.transpose();
  body.shape = std::move(shape);
}

double massOf(const BodySpec& spec, double volume_m3) {
  const double mass_kg = spec.mass_kg ? *spec.mass_kg : spec.density_kg_m3 * volume_m3;
  if (!(mass_kg >= kMinMass_kg && mass_kg <= kMaxMass_kg))
    throw Error(
        "by its volume and density a body must have 1e-9 to 1e15 kg, and this one has not: set its mass, 1e-9 "
        "to 1e9 kg");
  return mass_kg;
}

// Of a round bar, also of a disc, two sides of the bounds are equal. Of a cube, they do not decide.
int cylinderAxisOf(const Vec3& half) {
  constexpr double kEqual = 0.01;
  int longest = 2, axis = 2, candidates = 0;
  half.maxCoeff(&longest);
  for (int i = 0; i < 3; ++i) {
    const double one = half[(i + 1) % 3], other = half[(i + 2) % 3];
    if (std::abs(one - other) > kEqual * std::max(one, other)) continue;
    axis = i;
    ++candidates;
  }
  return candidates == 1 ? axis : longest;
}

void makeBox(const Vec3& half, const BodySpec& spec, Body& body) {
  body.shape = boxShape(half);
  body.mass = massOfBox(massOf(spec, 8 * half.prod()), half);
}

void makeBall(const Vec3& half, const BodySpec& spec, Body& body) {
  const double radius = half.maxCoeff();
  body.shape = ballShape(radius);
  body.mass = massOfBall(massOf(spec, 4 * std::numbers::pi / 3 * radius * radius * radius), radius);
}

void makeCapsule(const Vec3& half, const BodySpec& spec, Body& body) {
  const Bar bar = barOf(half, true);
  if (!(bar.half_length > 0)) return makeBall(half, spec, body);
  const double r = bar.radius;
  const double volume = std::numbers::pi * r * r * (2 * bar.half_length + 4 * r / 3);
  body.mass = massOfCapsule(massOf(spec, volume), bar.half_length, r);
  setTurned(capsuleShape(bar.half_length, r), turnTo(bar.axis), body);
}

void makeCylinder(const Vec3& half, const BodySpec& spec, Body& body) {
  const int axis = cylinderAxisOf(half);
  const double r = std::max(half[(axis + 1) % 3], half[(axis + 2) % 3]), half_length = half[axis];
  body.mass = massOfCylinder(massOf(spec, 2 * std::numbers::pi * r * r * half_length), half_length, r);
  setTurned(cylinderShape(half_length, r), turnTo(axis), body);
}

void makeHull(const Model& model, const BodySpec& spec, Body& body) {
  const Hull hull = hullOf(model.usedPositions());
  const Solid solid = solidOf(hull.shape);
  body.mass = massOfDensity(massOf(spec, solid.volume_m3) / solid.volume_m3, solid);
  body.shape = moved(hull.shape, -body.mass.centre_O);
  body.hull_error_m = hull.error_m;
}

void makeParts(const Model& model, const BodySpec& spec, Body& body) {
  MeshParts made = partsOfMesh(model);
  body.mass = massOfDensity(massOf(spec, made.solid.volume_m3) / made.solid.volume_m3, made.solid);
  body.shape = std::move(made.shape);
  body.hull_error_m = made.error_m;
  body.excess_m = made.excess_m;
  body.open_edges = made.open_edges;
  body.shell_m = made.shell_m;
}

}  // namespace

Body bodyOf(const Model& model, const BodySpec& spec) {
  Body body;
  body.surface = spec.surface;
  const Box bounds = model.bounds();
  if (bounds.empty()) throw Error("it has no vertices");
  if (!withinReach(bounds.min) || !withinReach(bounds.max)) throw Error("its vertices must lie within 1e9 m");
  const Vec3 half = bounds.size() / 2;
  if (!(half.minCoeff() > 0)) throw Error("a body must have a thickness in all directions");
  switch (spec.shape) {
    case BodyShape::kBall:
      makeBall(half, spec, body);
      break;
    case BodyShape::kCapsule:
      makeCapsule(half, spec, body);
      break;
    case BodyShape::kHull:
      makeHull(model, spec, body);
      return body;
    case BodyShape::kParts:
      makeParts(model, spec, body);
      return body;
    case BodyShape::kCylinder:
      makeCylinder(half, spec, body);
      break;
    case BodyShape::kBox:
      makeBox(half, spec, body);
      break;
  }
  body.mass.centre_O = bounds.centre();
  return body;
}

std::size_t partsIn(const Model& model, const BodySpec& spec) {
  return spec.shape == BodyShape::kParts ? bodyOf(model, spec).shape.parts.size() : 1;
}

}  // namespace hl
