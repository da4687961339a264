// Texture coordinates of a glTF document, as its pictures lie over them: those of the set that the picture of the base
// colour names become the first set, moved, turned and scaled by KHR_texture_transform.
#pragma once

#include <boost/json.hpp>
#include <string>
#include <vector>

#include "io/gltf_accessors.h"
#include "io/gltf_additions.h"

namespace hl {

/// Of a document that has been checked. Returns whether anything changed. Throws hl::Error, with the element, for what
/// is no transform; texture coordinates that cannot be had are a warning.
bool placePictures(boost::json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
                   std::vector<std::string>& warnings);

}  // namespace hl
