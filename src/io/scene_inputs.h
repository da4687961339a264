// SceneInputs: all that a scene is made from, by name and SHA-256, so that a result can be named by it.
//
// A model file names others in many ways, each known to the library that reads it. So whatever in a file could be the
// name of another, and is one of a file that is there, counts: rather one file too many than one that is missed.
#pragma once

#include <string>
#include <vector>

namespace hl {

struct SceneInput {
  std::string name;    ///< relative to the folder of the scene's file
  std::string sha256;  ///< 64 hexadecimal digits
};

/// The file of a scene first, then those that it names, those that these name, and the program that reads one of them
/// if it is none of HL's own, by name. None for a built-in scene. Throws hl::Error for a file that is not there.
std::vector<SceneInput> sceneInputs(const std::string& spec);

}  // namespace hl
