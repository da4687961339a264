// The pose of a glTF document without its animations: what skins and morph targets bend (glTF 2.0, 3.7.3 and 3.7.2.2)
// gets positions and normals of its own, as it stands.
#pragma once

#include <boost/json.hpp>
#include <string>
#include <vector>

#include "io/gltf_accessors.h"
#include "io/gltf_additions.h"

namespace hl {

/// Of a document that has been checked; it has no skins, morph targets and animations afterwards. Returns whether
/// anything changed. Throws hl::Error, with the element, for what contradicts itself; what cannot be bent is a warning.
bool poseGltf(boost::json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
              std::vector<std::string>& warnings);

}  // namespace hl
