// Field forces: what the fields of a scene do to the hand, wherever the proxy is: magnets, springs and constant forces
// of places, and regions that brake. docs/fields.md has their formulas, and what each may add.
#pragma once

#include "base/fixed_vector.h"
#include "proxy/object_forces.h"
#include "scene/scene_at.h"

namespace hl {

/// So many act at once, drags beside them; of more, the first of the scene.
inline constexpr std::size_t kMaxFieldsAtOnce = 4;

struct FieldForces {
  Vec3 force_N = Vec3::Zero();                        ///< on the hand, world axes; the sum of `forces`
  double damping_Ns_m = 0;                            ///< at the hand, of all regions together
  FixedVector<ObjectForce, kMaxFieldsAtOnce> forces;  ///< by object; a drag is none of them
};

/// At the place of the finger, m, world. RT-safe.
FieldForces fieldForces(const SceneAt& scene, const Vec3& finger);

}  // namespace hl
