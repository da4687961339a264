// The built-in scenes, by name: one source for use, display, benchmarks and tests.
#pragma once

#include <string>

#include "scene/scene_model.h"

namespace hl {

/// True for the name of a built-in scene, with or without :N. A file with the same name must be given with its folder.
bool isBuiltinScene(const std::string& spec);

/// Whether that scene has surfaces that are no meshes, and no model.
bool isBuiltinSurface(const std::string& spec);

/// Whether that scene is of several objects, some of them bodies.
bool hasBuiltinBodies(const std::string& spec);

/// List of the names, for help texts.
inline constexpr const char* kBuiltinScenes =
    "teapot[:N], walker, terrain:N, rough:N[:MEMBER], sphere:N, plane:N, pipe:N, pits:N, soup:N, field:terrain:N, "
    "ct:phantom:N, depth:table, points:sphere:N, points:terrain:N, sdf:torus, sdf:gyroid, sdf:blend, sdf:spheres, "
    "sdf:bracket, snaps, workshop";

/// Throws hl::Error with the list of names if the name is unknown.
/// Of a scene of several objects, all of it as one model.
Model makeBuiltinScene(const std::string& spec);
/// With its bodies, snaps and fields, or as the surfaces that it is.
SceneModel makeBuiltinWorld(const std::string& spec);

}  // namespace hl
