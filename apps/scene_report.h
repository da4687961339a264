// What is told of a scene wherever one is loaded: on a terminal, by hl info, to a page that has sent it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// What was skipped, and shapes of bodies that are far from their meshes; one line each. Throws hl::Error.
std::vector<std::string> warningsOf(const Snapshot& snapshot);
/// Triangles of a mesh, or of a surface whose primitives are triangles.
std::uint64_t trianglesOf(const Shape& shape);
/// "1 primitive", "2 primitives".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace hl
