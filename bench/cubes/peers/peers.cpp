#include <array>

#include "cubes/body_engine.h"

namespace hl::bench {

std::span<const BodyEngineKind> bodyPeers() {
  // Both solve all contacts at once: steps of a pile of a hundred take a hundred milliseconds and more.
  static constexpr std::array<BodyEngineKind, 4> kPeers{{{"bullet", makeBulletBodies, 1000},
                                                         {"ode quick", makeOdeBodies, 1000},
                                                         {"ode exact", makeOdeExactBodies, 20},
                                                         {"mujoco", makeMujocoBodies, 20}}};
  return kPeers;
}

}  // namespace hl::bench
