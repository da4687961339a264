// Body problem: what one step solves: the velocities of bodies and hands, and the contacts between them.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bodies/free_motion.h"
#include "bodies/joint_set.h"
#include "bodies/meetings.h"
#include "bodies/placed_bodies.h"
#include "bodies/row.h"
#include "bodies/scenery.h"
#include "bodies/world.h"

namespace hl {

/// How far bodies go in a step.
struct BodyWays {
  std::vector<Vec3> ways;     ///< m, of the centres
  std::vector<Vec3> turns;    ///< rad/s, while they move
  std::vector<double> parts;  ///< 0..1 of both, that nothing is in the way of
};

/// Made once for a world; its lists have room for any step. By one thread at a time.
struct BodyProblem {
  explicit BodyProblem(std::shared_ptr<const World> of);

  std::size_t bodies() const { return world->bodies.size(); }
  /// Row::kFixed if there is no such body.
  int numberOf(std::uint64_t key) const;
  double reachOf(std::size_t body) const { return world->bodies[body].shape.reach; }
  /// A body after its part of the way. RT-safe.
  BodyState stateAtEnd(const WorldState& state, std::size_t body, const BodyWays& plan) const;
  Pose poseAtEnd(const WorldState& state, std::size_t body, const BodyWays& plan) const;
  /// Whether there may be one more row, of `most` at most: a contact that is refused is counted. RT-safe.
  bool hasRoom(std::size_t most) {
    if (rows.size() < std::min(most, rows.capacity())) return true;
    ++dropped;
    return false;
  }
  bool hasRoom() { return hasRoom(rows.capacity()); }
  /// m/s at `point` (m, world), of what a meeting with the scene meets. RT-safe.
  Vec3 sceneryVelocityAt(PrimitiveId primitive, const Vec3& point) const {
    return sceneryVelocity(meetings.scene()->instance(primitive), times, period_s, point);
  }

  std::shared_ptr<const World> world;
  PlacedBodies placed;
  Meetings meetings;
  std::vector<std::size_t> awake;  ///< numbers of the bodies that are stepped, ascending
  std::vector<Mat3> turned;        ///< of each body at the begin of the step
  std::vector<Node> nodes;         ///< bodies, then hands
  std::vector<Node> before;        ///< the same, before gravity
  std::vector<Node> unpushed;      ///< the same, after gravity, before the impulses of the rows
  std::vector<Row> rows;
  std::size_t dropped = 0;  ///< contacts of the step that hasRoom() has refused; each as often as it was tried
  JointSet joints;
  std::vector<std::uint32_t> awake_joints;  ///< numbers of those whose bodies are awake, ascending
  std::vector<std::uint32_t> groups;        ///< of each body: joint_groups.h
  std::vector<PrincipalAxes> axes;          ///< of each body
  double period_s = 1e-3;
  std::uint64_t step = 0;  ///< its number
  StepTimes times;
};

/// How a pair moves: whether rows made for its begin may miss its end.
struct Pace {
  bool fast = false, turns = false;
};
Pace paceOf(const BodyProblem& problem, const Meeting& meeting);
/// m: how far any point of one goes in a step, seen from the other, at most.
double wayPastEachOther(const BodyProblem& problem, const Meeting& meeting);

/// m; the greatest overlap of a manifold, >= 0.
double deepestOf(const Manifold& manifold);

/// m; a contact with no more of a gap bears load, and no less of an overlap is pushed apart. At 1000 N/m a nanometre is
/// a micronewton; rounding at a metre is a millionth of it.
inline constexpr double kTouching_m = 1e-9;
/// m, and of the least overlap at which a pair has passed; a smaller overlap at the end of a step is left to what
/// pushes apart (motion_plan.h).
inline constexpr double kLeft_m = 1e-5, kLeft = 0.25;
inline double leftOf(const PlacedConvex& a, const PlacedConvex& b) {
  return std::min(kLeft_m, kLeft * (a.shape->thin + b.shape->thin));
}
/// m; a contact that bore load keeps its row up to this gap, so that the rows of what rests are the same in each step.
inline constexpr double kHeld_m = 1e-6;

}  // namespace hl
