// Scene files, *.hl.json: objects from model files, built-in scenes or inline primitives, with transforms, materials
// and textures. The format is proto/hl.proto's Scene in JSON; docs/scene-files.md describes it.
#pragma once

#include <string>

#include "io/load_model.h"
#include "scene/scene_model.h"

namespace hl {

/// True for a name that ends in .hl.json.
bool isSceneFile(const std::string& path);

/// Reads the scene and everything it refers to, relative to its folder. Throws hl::Error
/// "FILE:LINE: ...". Like loadModel, call it before the program starts threads.
SceneModel loadSceneFile(const std::string& path, const LoadOptions& options = {});

}  // namespace hl
