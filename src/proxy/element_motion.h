// Element motion: where a place on an element of a mesh goes while the mesh deforms.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "scene/scene_at.h"

namespace hl {

/// Displacement from `from_ns` to `to_ns`, within the transition `way` of the element's mesh, of the place with these
/// barycentric weights of the element's sorted vertices; frame of the object. Zero where the element is degenerate in
/// `scene`: its vertices are sorted otherwise then, and the weights belong to none of them. RT-safe.
Vec3 displacementOf_O(const SceneAt& scene, const MeshTransition& way, PrimitiveId element,
                      const std::array<double, 3>& weights, std::int64_t from_ns, std::int64_t to_ns);

}  // namespace hl
