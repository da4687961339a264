// Motion bounds: how far each body may go in a step, and so how near others must be for the two to meet.
//
// Nothing that is hit becomes more than twice as fast as the fastest body that hits it, directly or through others. So
// bodies that may meet in the step are one crowd, with the speed of its fastest; what is fast elsewhere does not count.
#pragma once

#include <algorithm>

#include "bodies/hand_node.h"
#include "bodies/islands.h"
#include "bodies/joint_rows.h"
#include "bodies/sweep_and_prune.h"

namespace hl {

/// m/s: no overlap is removed faster.
inline constexpr double kMaxApart_m_s = 0.05;
/// m/s at which an overlap (m) is removed, a part of it in each step.
inline double apartSpeed_m_s(double overlap, double period_s) {
  constexpr double kPushedApart = 0.2;
  return std::min(kPushedApart * overlap / period_s, kMaxApart_m_s);
}

/// By one thread at a time.
class MotionBounds {
 public:
  MotionBounds(const BodyProblem& problem, const JointRows& joints);

  /// From velocities, hands, joints, and the speed with which the scene may push. RT-safe.
  void find(const WorldState& state, std::span<const HandNode> hands, double scenery_m_s);
  /// Adds what it takes that these may go apart where they overlap. False: there is room already. RT-safe.
  bool makeRoom(const WorldState& state, std::span<const Meeting> meetings);
  const MostWays& ways() const { return ways_; }
  const SweepAndPrune& near() const { return near_; }

 private:
  void addHand(const HandNode& hand);
  void addCrowds(const WorldState& state);
  void spread();

  const BodyProblem& problem_;
  const JointRows& joints_;
  SweepAndPrune near_;
  MostWays ways_;
  Islands crowds_;
  // m/s, of each body, and what joints and overlaps may add; of the lowest of a crowd, the crowd's.
  std::vector<double> speeds_, added_;
};

}  // namespace hl
