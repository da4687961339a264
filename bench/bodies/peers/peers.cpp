#include <array>

#include "bodies/body_engine.h"

namespace hl::bench {

std::span<const BodyEngineKind> bodyPeers() {
  // ODE's exact step takes the third power of the number of contacts.
  static constexpr std::array<BodyEngineKind, 4> kPeers{{{"bullet", makeBulletBodies, 1000},
                                                         {"ode quick", makeOdeBodies, 1000},
                                                         {"ode exact", makeOdeExactBodies, 20},
                                                         {"mujoco", makeMujocoBodies, 1000}}};
  return kPeers;
}

}  // namespace hl::bench
