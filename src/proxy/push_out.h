// Push out: moves the proxy away from objects that have come too near. If it is pinched, its centre still stays outside
// all of them.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// A position found from `from` that is clear of the scene by tolerance.reach. If there is none, the search is repeated
/// for half the reach, a quarter, and so on, and the position with the largest clearance is returned. The centre
/// crosses no surface on the way. RT-safe.
Vec3 pushedOut(const SceneAt& scene, const Tolerances& tolerance, const Vec3& from);

}  // namespace hl
