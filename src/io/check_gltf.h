// What is asked of a glTF file before it is read. Its reader takes no notice of extensions that a file says it cannot
// be read without (glTF 2.0, 3.12), nor of members that are of another kind than they should be; it follows nodes that
// contain themselves to the end of its memory, and leaves out faces whose vertices do not exist.
#pragma once

#include <boost/json.hpp>
#include <string>
#include <vector>

#include "io/gltf_accessors.h"

namespace hl {

/// Whether the numbers of a primitive are packed by Draco, which assimp alone unpacks.
bool isPackedGltf(const boost::json::object& primitive);

/// Throws hl::Error for a file that needs an extension which is not read: what it changes of the shape would be
/// missing.
void checkGltfExtensions(const boost::json::value& file);
/// Throws hl::Error, with the element, for nodes and scenes that refer to what does not exist, contain themselves, are
/// nested too deep or have transforms of too few numbers.
void checkGltfNodes(const boost::json::value& file);
/// The same for primitives: of an unknown mode, without numbers for positions, with too few vertices or with indices
/// beyond them. What is left out is a warning.
void checkGltfMeshes(const boost::json::value& file, const GltfAccessors& accessors,
                     std::vector<std::string>& warnings);

}  // namespace hl
