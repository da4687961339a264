// Joint rows: the joints of a world in a step: their blocks for the solve, the bend of their ways, what is left to
// straighten, and their energy.
//
// What is held moves on a curve. The velocity of the step is that of its chord: it takes each joint to its place at the
// end of the step (the constraint algorithm SHAKE: J.-P. Ryckaert, G. Ciccotti, H. Berendsen, J. Comput. Phys. 23,
// 1977). So a door neither slows down nor drifts; along the tangent it would lose (w T)^2 of its energy in each step.
// Where bodies are much faster than a step resolves, or a mechanism is stretched out, chords would feed energy. So what
// holds the joints never gives more than it has taken, and that is little: else it holds along the tangents.
#pragma once

#include "bodies/body_problem.h"

namespace hl {

/// By one thread at a time.
class JointRows {
 public:
  explicit JointRows(BodyProblem& problem);

  /// Makes the blocks and applies the impulses of the last step. RT-safe, as all below.
  void begin(const WorldState& state);
  /// Raises, of each body, to what springs and tables, and what is off, may add at most to the speed of a point, m/s.
  void findSpeeds(std::span<double> speeds) const;
  /// Where the velocities found do not take a joint along its curve, asks for others. False: they do.
  bool bend(const WorldState& state);
  /// Asks for velocities along the tangents where chords would feed energy. False: they do not.
  bool refuse(const WorldState& state);
  /// Sets `apart` to velocities that take what is off to its place at the end of the plan. m, the worst; 0: nothing is.
  double straighten(const WorldState& state, const BodyWays& plan, JointSet& apart) const;
  /// After the solve, but for the energy of springs.
  void book(WorldState& state) const;
  /// After the motion.
  void remember(WorldState& state) const;

 private:
  void beginBlock(const WorldState& state, std::size_t number);
  void beginCoordinate(const JointState& last, JointBlock& block) const;
  void setLimits(JointBlock& block, double bent) const;
  double heldWork_J(const JointBlock& block) const;
  void spare(double& spare_J, double given_J, double most_J) const;
  double kinetic_J(const JointBlock& block) const;
  std::size_t groupOf(const JointBlock& block) const { return problem_.groups[static_cast<std::size_t>(block.a)]; }
  JointPlace placeAtEnd(const WorldState& state, const JointBlock& block, const BodyWays& plan) const;
  Vec3 centreOf(int node) const;

  BodyProblem& problem_;
  BodyWays chord_;             // as the velocities have it
  std::vector<Vec6> off_;      // m, of each joint at the begin of the step
  std::vector<double> bent_;   // m or rad, the coordinate at the end beyond that of the velocity
  std::vector<double> fed_J_;  // of each group of bodies, beyond what it may
};

}  // namespace hl
