// What is asked of a glTF file before it is read: its reader takes no notice of extensions that a file says it cannot
// be read without (glTF 2.0, 3.12).
#pragma once

#include <string>

namespace hl {

/// The JSON of a .gltf or .glb file; empty if it cannot be opened.
std::string gltfJson(const std::string& path);
/// `text`: gltfJson(). Throws hl::Error for one that needs an extension which is not read: what it changes of the shape
/// would be missing.
void checkGltf(const std::string& text);

}  // namespace hl
