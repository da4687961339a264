// What an X3D file says about rigid bodies, which assimp does not hand on: its component RigidBodyPhysics
// (ISO/IEC 19775-1, clause 37).
#pragma once

#include <functional>
#include <string>

#include "scene/scene_model.h"

namespace hl {

/// Whether the text of an X3D file has a node that readX3dBodies() would read.
bool speaksOfBodies(const std::string& text);

/// The scene of an X3D file: its bodies, each with the shapes of its collidables, its joints, and the rest of it as
/// what stays. `read` makes the geometry of the text of a document, and throws hl::Error where it cannot. What is
/// strange or not supported becomes a warning. Throws hl::Error, one line, for text that is no XML, and what `read`
/// throws for the rest of the file.
SceneModel readX3dBodies(const std::string& text, const std::function<Model(const std::string& document)>& read);

}  // namespace hl
