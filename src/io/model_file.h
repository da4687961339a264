// ModelFile: a file as its reader gets it, in the process that reads it.
#pragma once

#include <string>

namespace hl {

struct ModelFile {
  std::string path;
  std::string ending;  ///< as endingOf()
  bool alone = false;  ///< nothing else may be opened; what it names beside it becomes a warning
  bool mesh = false;   ///< points without faces are the points of a mesh, and no cloud
  std::string name{};  ///< as its user calls it, where the path does not say it; without folders
};

}  // namespace hl
