// What a glTF file says about touch, which assimp does not hand on: friction from KHR_physics_rigid_bodies, stiffness
// and friction textures from MPEG_haptic_material (ISO/IEC 23090-14).
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scene/material.h"
#include "scene/texture.h"

namespace hl {

/// Material numbers count from 1: 0 is the plain one of nodes that say nothing.
struct GltfHaptics {
  std::vector<Material> materials{Material{}};
  std::vector<Texture> textures;
  std::map<std::string, std::size_t> material_of_node;  ///< by the node's name
  std::vector<std::string> warnings;
};

/// `text`: the JSON of the .gltf or .glb file at `path` (gltfJson()). A node's material is that of its collider (KHR)
/// or of its mesh (MPEG; wins). Nodes without a name, or with one that several have, are left out with a warning: they
/// could not be distinguished later. MPEG gives no units: a texture's range is 0..1 unless its `extras` have "low" and
/// "high"; its one friction is both static and dynamic. Images must be files, and of one that comes `alone` there are
/// none. Never throws for what is missing or strange, only warns.
GltfHaptics readGltfHaptics(const std::string& text, const std::string& path, bool alone = false);

}  // namespace hl
