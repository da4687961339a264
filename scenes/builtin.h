// The built-in scenes, by name: touched, watched, timed and tested from one source.
#pragma once

#include <string>

#include "scene/model.h"

namespace hl {

/// True for a name (with or without :N) of a built-in scene; a file of the same name must be given with its folder.
bool isBuiltinScene(const std::string& spec);

/// What there is, for people to read.
inline constexpr const char* kBuiltinScenes =
    "teapot[:N], walker, terrain:N, rough:N[:MEMBER], sphere:N, plane:N, pipe:N, pits:N, soup:N";

/// Throws hl::Error with the list for any other.
Model makeBuiltinScene(const std::string& spec);

}  // namespace hl
