// Worlds with joints, for tests.
#pragma once

#include "bodies/joint_in_world.h"
#include "test_worlds.h"

namespace hl::test {

inline Joint named(std::uint64_t key, std::uint64_t a, std::uint64_t b, Joint joint) {
  joint.key = key;
  joint.body_a = a;
  joint.body_b = b;
  return joint;
}

/// m: how far the worst joint is off its place.
inline double worstOff(const Playground& play) {
  double worst = 0;
  for (const Joint& joint : play.world->joints)
    worst = std::max(worst, jointPlace(joint, *play.world, play.state).off(0.01).norm());
  return worst;
}

inline World weightless(std::vector<Body> bodies, std::vector<Joint> joints) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = std::move(bodies);
  world.joints = std::move(joints);
  return world;
}

inline World heavy(std::vector<Body> bodies, std::vector<Joint> joints) {
  World world = weightless(std::move(bodies), std::move(joints));
  world.gravity_m_s2 = Vec3(0, -kGravity, 0);
  return world;
}

/// A thin rod of this length, its middle at `middle`, at `angle_rad` from hanging down, about +z; hinged to the world
/// at its upper end.
struct HingedRod {
  double mass_kg = 0.1, length_m = 0.3;
  Vec3 hinge = Vec3::Zero();
  double angle_rad = 0;

  Pose pose() const {
    const Mat3 turn = Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()).toRotationMatrix();
    return {turn, hinge + turn * Vec3(0, -length_m / 2, 0)};
  }
  /// Of a rod without thickness, but for what keeps its inertia definite.
  Body body(std::uint64_t key) const {
    Body made = block(key, mass_kg, Vec3(1e-4, length_m / 2, 1e-4), 0);
    made.mass = massOfBox(mass_kg, Vec3(1e-6, length_m / 2, 1e-6));
    return made;
  }
  /// Its coordinate is the angle from hanging down.
  Joint joint(std::uint64_t key, std::uint64_t of) const {
    Joint made = named(key, of, 0, jointAt(JointKind::kHinge, hinge, Vec3::UnitZ(), HingedRod(*this).hanging()));
    return made;
  }
  Pose hanging() {
    angle_rad = 0;
    return pose();
  }
};

}  // namespace hl::test
