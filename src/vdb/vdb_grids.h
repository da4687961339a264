// The grids of an OpenVDB or a NanoVDB file, and which of them is meant.
#pragma once

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

#include "io/model_file.h"

namespace hl {

/// What a file gives of one of its grids.
struct GridInFile {
  std::string name;
  std::string type;  ///< of its values, for users: "float"
  bool floats = false, level_set = false;
};

/// Number of the one with this name; without a name of the only level set, or the only one of floats. Throws hl::Error,
/// which says what there is, if there is no such grid or several.
std::size_t chosenGrid(const std::vector<GridInFile>& grids, const std::string& name);

/// That grid. In a process of its own; throws hl::Error, one line.
openvdb::FloatGrid::Ptr readVdbGrid(const ModelFile& file, const std::string& name);

}  // namespace hl
