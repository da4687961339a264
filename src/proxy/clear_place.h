// Clear place: pushes a sphere that overlaps the scene out of it, without its centre ever crossing a surface.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// Moves `position` to a place clear of the scene by tolerance.reach, in at most `tries` steps of that length; false
/// when it has not found one, with `position` as far as it came. RT-safe.
bool findClearPlace(const SceneAt& scene, const Tolerances& tolerance, int tries, Vec3& position);

/// Distance from `position` to the nearest surface, or `most` when nothing is as near. RT-safe.
double clearanceAt(const SceneAt& scene, const Vec3& position, double most);

}  // namespace hl
