// Hand rows: what holds a hand's proxy, and what it will meet within the step: a body that comes flying, the wall
// behind it. Without the latter a body would feel the hand one step late, and a light one be flung away.
#pragma once

#include "bodies/body_problem.h"
#include "bodies/contact_rows.h"
#include "bodies/hand_node.h"
#include "bodies/motion_bounds.h"

namespace hl {

/// By one thread at a time.
class HandRows {
 public:
  HandRows(BodyProblem& problem, const ContactRows& contacts, const MotionBounds& bounds)
      : problem_(problem), contacts_(contacts), bounds_(bounds) {}

  /// Rows of hand number `hand`, whose node is there; for what it may meet in the step. RT-safe.
  void add(const HandNode& hand, std::size_t number, ContactMemory& memory);

 private:
  void addHeld(const HandContact& contact, int node, std::uint64_t name, ContactMemory& memory);
  double addNearBodies(const HandNode& hand, int node, std::uint64_t name, ContactMemory& memory);
  void addNearScene(const HandNode& hand, int node, std::uint64_t name, double margin, ContactMemory& memory);
  void addNearPart(const HandNode& hand, Row row, const PlacedConvex& part, double margin, ContactMemory& memory);
  void addNear(Row row, ContactMemory& memory);

  BodyProblem& problem_;
  const ContactRows& contacts_;  // knows what acted where in the last step
  const MotionBounds& bounds_;
  std::size_t most_ = 0;  // rows there may be once the hand has its own
};

}  // namespace hl
