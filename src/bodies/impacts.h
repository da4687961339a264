// Impacts: how fast what bounced goes apart. The impacts of a step follow one another, each with Newton's restitution,
// until nothing approaches: so in a row of balls the last one leaves. All points of two bodies that meet are one
// impact: a face that falls flat goes up flat. They are as fast as where they meet, within the step: what gravity adds
// after that would add energy at each bounce. No such impact adds kinetic energy. With friction the solve that follows
// may: then the bounces of that island are made weaker. Where joints hold bodies together, each contact has Newton's
// restitution by itself: an impact there moves more than the two bodies that meet.
#pragma once

#include <span>
#include <vector>

#include "bodies/body_problem.h"
#include "bodies/islands.h"

namespace hl {

/// By one thread at a time.
class Impacts {
 public:
  explicit Impacts(const BodyProblem& problem);

  /// Keeps the velocities before the impulses of the step. RT-safe.
  void begin() { free_ = problem_.nodes; }
  /// Sets what velocity apart the rows of bodies demand. False: nothing bounces. RT-safe.
  bool find(std::vector<Row>& rows);
  /// After a solve: halves what rows demand in islands that have more kinetic energy than before the step's impulses;
  /// `last`: takes all of it. False: there are none. RT-safe.
  bool weaken(std::vector<Row>& rows, bool last);

 private:
  void findIslands(const std::vector<Row>& rows);
  /// m/s along the normal of a row, by gravity in this step.
  double speedByGravity(const Row& row) const;
  double partBefore(const Row& row) const;
  void stopWhereTheyMeet(const std::vector<Row>& rows);
  void follow(std::vector<Row>& rows);
  bool bounce(std::span<const Row> pair);
  bool isJoined(const Row& row) { return joined_[static_cast<std::size_t>(islands_.of(row.a))] != 0; }
  double kineticOf(const Node& node, std::size_t number) const;
  double workOf(const JointBlock& block) const;

  const BodyProblem& problem_;
  std::vector<Node> free_, after_;
  std::vector<double> gained_J_;  // by island
  std::vector<double> before_;    // by island: the part of the step that goes by before its first impact
  std::vector<char> joined_;      // by island: whether it has joints
  Islands islands_;
};

}  // namespace hl
