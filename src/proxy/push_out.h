// Push out: where a proxy goes that things have come too near to; pinched, its centre keeps away from all of them.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// The place clear of the scene by tolerance.reach that is found from `from`. Where there is no room for the proxy, the
/// roomiest place that is found by looking for room for all of it, for half of it, for a quarter, and so on. The centre
/// crosses no surface on the way. RT-safe.
Vec3 pushedOut(const SceneAt& scene, const Tolerances& tolerance, const Vec3& from);

}  // namespace hl
