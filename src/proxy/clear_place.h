// Clear place: pushes a sphere out of the scene that it overlaps, without its centre crossing a surface.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// Moves `position` to a place clear of the scene by tolerance.reach, in at most `tries` steps of at most that length.
/// Returns false if none was found; `position` is then the last place tried. RT-safe.
bool findClearPlace(const SceneAt& scene, const Tolerances& tolerance, int tries, Vec3& position);

/// Distance from `position` to the nearest surface, but at most `most`. RT-safe.
double clearanceAt(const SceneAt& scene, const Vec3& position, double most);

}  // namespace hl
