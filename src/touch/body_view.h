// BodyView: what the loop that ticks shows of the bodies.
#pragma once

#include <cstdint>

#include "bodies/energy_book.h"

namespace hl {

struct BodyView {
  std::uint64_t bodies = 0;    ///< that can move; 0: the scene has none, and the rest is nothing
  std::uint64_t awake = 0;     ///< of them, in the last step
  std::uint64_t steps = 0;     ///< since they began
  double lost_s = 0;           ///< by how much their time is behind: steps that came late, or not at all
  double kinetic_J = 0;        ///< now
  double gravity_J = 0;        ///< now, with the origin as zero
  double spring_J = 0;         ///< now, in the springs and tables of joints
  EnergyBook energy{};         ///< since they began
  std::uint64_t dropped = 0;   ///< contacts without room, since they began
  std::uint64_t unsolved = 0;  ///< steps whose solve ended at its limit of work
  std::uint64_t returned = 0;  ///< bodies put back that had left their room, or whose state was not finite
};

}  // namespace hl
