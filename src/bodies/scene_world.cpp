#include "bodies/scene_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/joint_check.h"
#include "bodies/made_bodies.h"
#include "bodies/mesh_parts.h"
#include "geometry/primitive.h"

namespace hl {

namespace {

// kg; beyond them squares of numbers in a step are no longer exact enough.
constexpr double kLeastMass_kg = 1e-9, kMostMass_kg = 1e15;

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
  if (!(mass_kg >= kLeastMass_kg && mass_kg <= kMostMass_kg))
    throw Error("a body must have a mass of 1e-9 to 1e15 kg, and this one has not: set its mass");
  return mass_kg;
}

// Of a round bar, also of a disc, two sides of the bounds are equal. Of a cube, they do not tell.
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
}

// Of a body of the scene: what is wrong with it is told with its name.
template <typename Make>
auto named(const Instance& instance, Make make) {
  try {
    return make();
  } catch (const Error& error) {
    throw Error(instance.body->name + ": " + error.what());
  }
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

std::size_t partsIn(const std::shared_ptr<const Shape>& shape, const BodySpec& spec) {
  return spec.shape == BodyShape::kParts ? madeBody(shape, spec)->shape.parts.size() : 1;
}

std::size_t partsIn(const Snapshot& snapshot) {
  std::size_t parts = 0;
  for (const Instance& instance : snapshot.instances) {
    if (instance.movesAsBody()) parts += named(instance, [&] { return partsIn(instance.shape, instance.body->spec); });
  }
  return parts;
}

Joint jointOf(const JointSpec& spec, const Pose& start_a, const Pose& start_b) {
  Joint joint = spec.kind == JointKind::kDistance ? distanceBetween(spec.anchor_W, spec.anchor_b_W, start_a, start_b)
                                                  : jointAt(spec.kind, spec.anchor_W, spec.axis_W, start_a, start_b);
  const JointForces as_it_stands = joint;  // of a distance
  static_cast<JointForces&>(joint) = spec.along;
  if (spec.kind == JointKind::kDistance && spec.along == JointForces{}) static_cast<JointForces&>(joint) = as_it_stands;
  joint.key = spec.key;
  joint.body_a = spec.body_a;
  joint.body_b = spec.body_b;
  joint.collide = spec.collide;
  return joint;
}

namespace {

Pose startOf(const Snapshot& snapshot, std::uint64_t key) {
  for (const Instance& instance : snapshot.instances) {
    if (instance.key == key && instance.movesAsBody()) return instance.body->start;
  }
  return {};
}

// The same joint, told from its other side: with its axis turned round the coordinate stays what it is.
JointSpec turnedRound(JointSpec spec) {
  std::swap(spec.body_a, spec.body_b);
  if (spec.kind == JointKind::kDistance) std::swap(spec.anchor_W, spec.anchor_b_W);
  spec.axis_W = -spec.axis_W;
  return spec;
}

// A joint to what does not move is one to the world; one of two such things is none.
void addJoints(const Snapshot& snapshot, World& world) {
  std::uint64_t place = 0;
  for (JointSpec spec : snapshot.mechanics.joints) {
    ++place;
    if (spec.key == 0) spec.key = place;
    if (!world.has(spec.body_a)) spec = turnedRound(std::move(spec));
    if (!world.has(spec.body_a)) continue;
    if (!world.has(spec.body_b)) spec.body_b = 0;
    world.joints.push_back(jointOf(spec, startOf(snapshot, spec.body_a), startOf(snapshot, spec.body_b)));
    try {
      checkJoint(world.joints.back(), [&](std::uint64_t number) { return world.has(number); });
    } catch (const Error& error) {
      throw Error(spec.name + ": " + error.what());
    }
  }
  std::sort(world.joints.begin(), world.joints.end(), [](const Joint& x, const Joint& y) { return x.key < y.key; });
}

}  // namespace

std::shared_ptr<const World> worldOf(const Snapshot& snapshot) {
  auto world = std::make_shared<World>();
  std::vector<Instance> fixed;
  std::size_t parts = 0;
  for (const Instance& instance : snapshot.instances) {
    if (!instance.movesAsBody()) {
      fixed.push_back(instance);
      world->fixed_surfaces.push_back(instance.body ? std::optional(instance.body->spec.surface) : std::nullopt);
      continue;
    }
    world->bodies.push_back(named(instance, [&] { return *madeBody(instance.shape, instance.body->spec); }));
    world->bodies.back().key = instance.key;
    parts += world->bodies.back().shape.parts.size();
  }
  if (world->bodies.empty()) return nullptr;
  if (parts > kMostBodies)
    throw Error("its bodies have " + std::to_string(parts) + " parts, and at most " + std::to_string(kMostBodies) +
                " can move");
  if (!fixed.empty()) world->fixed = makeSnapshot(std::move(fixed));
  world->gravity_m_s2 = snapshot.mechanics.gravity_m_s2;
  addJoints(snapshot, *world);
  return world;
}

}  // namespace hl
