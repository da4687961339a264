// HeldContacts: what a tick leaves to the servo steps that come before the next one. A late tick then means planes that
// are a little old, not a proxy that stands still while the finger moves: each step solves the planes again with its
// own finger.
#pragma once

#include "base/fixed_vector.h"
#include "control/servo.h"
#include "proxy/solver.h"
#include "touch/felt_contact.h"

namespace hl {

struct HeldContacts {
  ServoTarget target;  ///< of the tick
  FixedVector<Plane, kMaxActive>
      planes_D;                ///< above which the proxy's centre stays; none: it stays where the tick put it
  FeltContacts contacts;       ///< of the tick
  Vec3 held_N = Vec3::Zero();  ///< force of a snap or of matter on the hand in the tick

  /// The target with the finger where it is now: the proxy is the point above all planes nearest to it. As the proxy
  /// before is above the same planes, the spring never gains by it. RT-safe.
  ServoTarget at(const Vec3& finger_D) const;
};

}  // namespace hl
