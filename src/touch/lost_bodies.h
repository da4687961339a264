// Lost bodies: those that left their room, so that nothing is lost that falls from a table and no body is ever so far
// away that its place is inexact; and those whose state is not finite, which would spread to all that they meet. They
// are put back where they started, at rest.
#pragma once

#include <vector>

#include "touch/body_acts.h"

namespace hl {

/// By the loop that steps the bodies.
class LostBodies {
 public:
  enum class Kind { kNone, kOutside, kNotFinite };

  /// `starts`: where bodies and joints go back to. Allocates.
  explicit LostBodies(const WorldState& starts);

  /// Before a step: whether the state of a body is not finite. RT-safe.
  Kind findNotFinite(const MovingBodies& moving);
  /// After a step; the worst that was found. RT-safe.
  Kind find(const MovingBodies& moving);
  /// Those that were found, and with them what joints connect with them, or that would be torn apart; returns how many.
  /// `groups`: of each body, jointGroups(). RT-safe.
  std::size_t putBack(const MovingBodies& moving, std::span<const std::uint32_t> groups);

 private:
  void addJoined(const MovingBodies& moving, std::span<const std::uint32_t> groups);

  std::vector<BodyState> starts_;         // of the bodies
  std::vector<JointState> joint_starts_;  // as World::joints
  std::vector<std::uint8_t> lost_;        // of each body: whether it is to be put back
};

}  // namespace hl
