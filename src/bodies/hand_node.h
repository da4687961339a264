// Hand node: a finger's proxy inside the solve of the bodies. The proxy hangs on the servo's spring K. At the end of
// the step the force is F = K (e + T v), e the stretch at its begin and v the proxy's velocity: so the proxy is a node
// of mass K T^2 that begins at -e / T, where nothing holds it. Then with bodies of any mass
//
//   change of energy + work on the hand <= K |way of the finger|^2 / 2,
//
// the leak of a wall that does not move. A force that counts only a part of T v would feed energy, or not be the one
// that the hand feels, K (proxy - finger) after the step: what a body gets and a hand feels would differ.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "bodies/world.h"

namespace hl {

/// What holds the proxy: a body, or the fixed scene.
struct HandContact {
  std::uint64_t key = 0;        ///< of the body; 0: something that does not move
  Vec3 point = Vec3::Zero();    ///< m, world
  Vec3 normal = Vec3::UnitZ();  ///< unit, toward the proxy
  double static_friction = 0, dynamic_friction = 0;
  bool slipping = false;  ///< in the last tick
};

/// An impulse on a body.
struct BodyImpulse {
  std::uint64_t key = 0;
  Vec3 point = Vec3::Zero();
  Vec3 impulse_N_s = Vec3::Zero();
};

struct HandNode {
  Vec3 proxy = Vec3::Zero();    ///< m, world: its centre
  double radius_m = 0;          ///< of the proxy; > 0: it also meets what it does not touch yet
  Vec3 stretch = Vec3::Zero();  ///< m, proxy - finger
  double spring_N_m = 1000;     ///< > 0, with the stiffness of the surface
  FixedVector<HandContact, kContactsOfHand> contacts;
  /// What the last steps' forces have given the hand, and no body yet; paid before the solve.
  FixedVector<BodyImpulse, kContactsOfHand> owed;
};

/// What a hand has given in a step: of `owed`, to each body that it touched, and to all that does not move (key 0).
using GivenImpulses = FixedVector<BodyImpulse, 2 * kContactsOfHand + 1>;

}  // namespace hl
