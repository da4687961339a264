// BodiesView: what the rigid bodies did, for those who watch the session.
#pragma once

#include <cstddef>
#include <cstdint>

#include "touch/body_world.h"

namespace hl {

/// Of the scene of the last tick, but for the counts, which go on.
struct BodiesView {
  std::size_t bodies = 0;  ///< that can move
  /// Faster than 1 mm/s at their fastest point, and the energies; looked at in each kSeldom-th step.
  std::size_t moving = 0;
  double kinetic_J = 0, gravity_J = 0;
  EnergyBook book{};
  std::uint64_t dropped = 0;      ///< contacts without room
  std::uint64_t unconverged = 0;  ///< steps whose solve ended at its limit of work
  std::uint64_t returned = 0;     ///< bodies that left their room, and were put back

  /// After a tick; null: its scene has no bodies. RT-safe.
  void follow(const BodyWorld* bodies);

  static constexpr std::uint64_t kSeldom = 100;
};

}  // namespace hl
