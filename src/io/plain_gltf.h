// A glTF 2.0 file as its reader expects it: positions, normals and texture coordinates in floats, where
// KHR_mesh_quantization or the core has integers, which the reader takes for the bits of floats; turns of length 1;
// what skins and morph targets bend as it stands, as it applies neither and crashes where a skin has no matrices.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/model_file.h"

namespace hl {

/// The JSON of a .gltf or .glb file; empty if it cannot be opened.
std::string gltfJson(const std::string& path);

/// The same file in such terms; nothing where it is so already. Throws hl::Error, with the element, for a file that is
/// cut, contradicts itself or needs an extension that is not read (check_gltf.h, gltf_accessors.h). What is left out is
/// a warning.
std::optional<std::string> plainGltf(const ModelFile& file, std::vector<std::string>& warnings);

}  // namespace hl
