// Plain X3D: an X3D file with the nodes that assimp reads, in the place of those that it does not.
#pragma once

#include <string>
#include <vector>

namespace hl {

/// The same shapes in other words, of a text without prototypes: groups of all kinds are Group or Transform, there
/// again where they are used again; a LOD is its first, finest level, and a Switch its choice; strips and quads are
/// faces, and lines of many points are many lines; lists have no commas, and axes of rotations have length 1. What
/// cannot be shown (Inline, Text, ...) is left out with a warning. Throws hl::Error, one line, for what is no XML.
std::string plainX3d(const std::string& text, std::vector<std::string>& warnings);

}  // namespace hl
