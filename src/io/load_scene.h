// A scene as a user names it: a built-in one or a model file.
#pragma once

#include <string>

#include "io/load_model.h"
#include "scene/scene_model.h"

namespace hl {

/// Throws hl::Error, one line.
SceneModel loadScene(const std::string& spec, const LoadOptions& options = {});

}  // namespace hl
