// Worlds for tests: a floor, balls and blocks, and a finger that pushes along one axis.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "bodies/body_step.h"

namespace hl::test {

inline constexpr double kStep_s = 1e-3;
inline constexpr double kGravity = 9.81;

/// Two triangles in the plane y = 0, turned by `slope_rad` about z.
inline std::shared_ptr<const Snapshot> floorScene(double half_m = 1, double slope_rad = 0) {
  const Mat3 turn = Eigen::AngleAxisd(slope_rad, Vec3::UnitZ()).toRotationMatrix();
  Model model;
  for (const Vec3& corner :
       {Vec3(-half_m, 0, -half_m), Vec3(half_m, 0, -half_m), Vec3(half_m, 0, half_m), Vec3(-half_m, 0, half_m)})
    model.positions.emplace_back(turn * corner);
  model.triangles = {{0, 2, 1}, {0, 3, 2}};
  return makeSnapshot(std::move(model));
}

/// Twelve triangles.
inline Model boxModel(const Vec3& half) {
  const Convex shape = boxShape(half);
  Model model;
  model.positions = shape.vertices;
  for (const Convex::Face& face : shape.faces) {
    model.triangles.push_back({face.corners[0], face.corners[1], face.corners[2]});
    model.triangles.push_back({face.corners[0], face.corners[2], face.corners[3]});
  }
  return model;
}

/// Without a hierarchy.
inline Instance instanceOf(Model model, std::uint64_t key, const Motion& motion = Motion()) {
  Instance instance;
  instance.shape = makeShape(std::move(model), HierarchyKind::kNone);
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = motion;
  instance.key = key;
  return instance;
}

/// Of a polyhedron of uniform density.
inline Mass massOfShape(double mass_kg, const Convex& polyhedron) {
  const Solid solid = solidOf(polyhedron);
  return massOfDensity(mass_kg / solid.volume_m3, solid);
}

inline Body block(std::uint64_t key, double mass_kg, const Vec3& half_m, double friction) {
  return {key, massOfBox(mass_kg, half_m), boxShape(half_m), {friction, friction, 0}};
}
inline Body ball(std::uint64_t key, double mass_kg, double radius_m, double friction, double restitution = 0) {
  return {key, massOfBall(mass_kg, radius_m), ballShape(radius_m), {friction, friction, restitution}};
}

inline Pose placeAt(const Vec3& origin, const Mat3& rotation = Mat3::Identity()) { return {rotation, origin}; }

/// A world with its state, stepped as one.
struct Playground {
  Playground(World made, const std::vector<Pose>& poses, double period = kStep_s)
      : world(std::make_shared<const World>(std::move(made))),
        state(startWorld(*world, poses)),
        stepper(world),
        period_s(period) {}

  BodyStepReport step(std::span<const HandNode> hands = {}) {
    return stepper.step(state, period_s, hands, std::span(given).first(hands.size()));
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  double energy_J() const {
    return kineticEnergy_J(*world, state) + gravityEnergy_J(*world, state) + springEnergy_J(*world, state);
  }
  /// Sum of m v.
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < state.bodies.size(); ++i)
      sum += world->bodies[i].mass.mass_kg * state.bodies[i].velocity;
    return sum;
  }

  std::shared_ptr<const World> world;
  WorldState state;
  BodyStepper stepper;
  double period_s;
  std::array<GivenImpulses, kMaxHands> given;
};

/// A finger that pushes one body along +x at a point fixed in the world's y and z: the proxy of a sphere of radius 0,
/// which needs no tick. What the hand feels and the body gets is kept exact by owing.
struct Pusher {
  std::uint64_t key = 1;
  double spring_N_m = 1000;
  Vec3 finger = Vec3::Zero();  ///< m; x is moved by the caller
  Vec3 proxy = Vec3::Zero();
  Vec3 force_N = Vec3::Zero();  ///< on the hand
  bool touching = false;
  FixedVector<BodyImpulse, kContactsOfHand> owed;

  HandNode node() const {
    HandNode hand;
    hand.stretch = proxy - finger;
    hand.spring_N_m = spring_N_m;
    if (touching) hand.contacts.push({key, proxy, -Vec3::UnitX(), 0, 0, false});
    hand.owed = owed;
    return hand;
  }
  /// After the step: `surface_x` is where the body's surface now is.
  void tick(double surface_x, double period_s, const GivenImpulses& given) {
    proxy = finger;
    touching = finger.x() >= surface_x;
    if (touching) proxy.x() = surface_x;
    force_N = spring_N_m * (proxy - finger);
    Vec3 got = Vec3::Zero();
    for (const BodyImpulse& one : given) {
      if (one.key != 0) got += one.impulse_N_s;
    }
    Vec3 due = -period_s * force_N - got;
    for (const BodyImpulse& one : owed) due += one.impulse_N_s;
    owed.clear();
    owed.push({key, proxy, due});
  }
};

}  // namespace hl::test
