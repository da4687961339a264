// Held bodies: what becomes of what went a part of its way only (motion_plan.h).
//
// The first time it keeps its velocity, so that the next step has the impact; gravity gives no energy for a way that
// was not gone. What stops short again and again is held in a way that the rows do not see:
//   by other bodies   they stick together: all go and move on as one rigid body with their momentum and angular
//                     momentum. Of all motions with these, that one has the least energy.
//   by the scene      and what lies on it, presses on it or would go into it: it loses velocity as it does way
#pragma once

#include <vector>

#include "bodies/islands.h"
#include "bodies/motion_plan.h"

namespace hl {

/// By one thread at a time.
class HeldBodies {
 public:
  HeldBodies(BodyProblem& problem, MotionPlan& plan);

  /// Finds what sticks together, and lets it go as one. RT-safe.
  void plan(const WorldState& state);
  /// The velocities of the nodes, after all impulses. What is lost is booked as lost in contacts. RT-safe.
  void slow(WorldState& state);

 private:
  /// Bodies that stick together.
  struct Cluster {
    bool sticks = false;  // bodies are in each other's way
    bool fixed = false;   // something that does not move holds one of them
    // Of what sticks: measureClusters().
    double mass_kg = 0;
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();        // m, m/s
    Vec3 angular_momentum = Vec3::Zero(), spin = Vec3::Zero();  // kg m^2/s about the centre, rad/s
    Mat3 inertia = Mat3::Zero();                                // kg m^2, the same
  };

  Cluster& clusterOf(std::size_t body) {
    return clusters_[static_cast<std::size_t>(islands_.of(static_cast<int>(body)))];
  }
  bool isHeld(const WorldState& state, int body) const;
  void findClusters(const WorldState& state);
  void findFixed();
  void measureClusters(const WorldState& state);
  bool goesAsOne(const WorldState& state, int cluster);
  double keptBy(std::uint32_t group, double part, bool held) const;
  double kineticEnergy_J(std::size_t body) const;

  BodyProblem& problem_;
  MotionPlan& plan_;
  Islands islands_;
  std::vector<Cluster> clusters_;  // by the lowest body of each
  std::vector<double> kept_;       // of the velocity of a group, by its first body
  bool any_ = false;               // something goes a part of its way only
};

}  // namespace hl
