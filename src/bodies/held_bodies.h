// Held bodies: the velocities of what went a part of its way only (motion_plan.h).
//
// The first time it keeps them, so that the next step has the impact; gravity gives no energy for a way that was not
// gone. What stops short again and again is held in a way that the rows do not see:
//   by other bodies   they stick together: all move as one rigid body with their momentum and angular momentum. Of all
//                     motions with these, that one has the least energy.
//   by the scene      it loses velocity as it does way
#pragma once

#include <vector>

#include "bodies/islands.h"
#include "bodies/motion_plan.h"

namespace hl {

/// By one thread at a time.
class HeldBodies {
 public:
  HeldBodies(BodyProblem& problem, const MotionPlan& plan);

  /// Of the nodes of the problem. What is lost is booked as lost in contacts. RT-safe.
  void slow(WorldState& state);

 private:
  /// Bodies that stick together.
  struct Cluster {
    bool stops = false;   // something is in its way
    bool sticks = false;  // it has several groups
    bool fixed = false;   // one of them is held by the scene

    bool isFree() const { return stops && !fixed; }
    double mass_kg = 0;
    Vec3 moment = Vec3::Zero();    // kg m
    Vec3 momentum = Vec3::Zero();  // kg m/s
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), angular = Vec3::Zero();
    Vec3 spin = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
  };

  void count(WorldState& state);
  bool isHeld(const WorldState& state, int body) const;
  void findClusters(const WorldState& state);
  void measureClusters(const WorldState& state);
  double keptBy(std::uint32_t group, double part, bool by_scene) const;
  double kineticEnergy_J(std::size_t body) const;

  BodyProblem& problem_;
  const MotionPlan& plan_;
  Islands islands_;
  std::vector<Cluster> clusters_;  // by the lowest body of each
  std::vector<double> kept_;       // of the velocity of a group, by its first body
};

}  // namespace hl
