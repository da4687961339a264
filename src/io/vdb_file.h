// Files of sparse grids, OpenVDB .vdb and NanoVDB .nvdb: read by a program of its own, hl-vdb, which has OpenVDB, as
// few need it and it is large.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "io/isolated.h"
#include "scene/scene_model.h"

namespace hl {

/// Of this ending: ".vdb", ".nvdb".
bool readsVdb(const std::string& ending);

/// Why a grid cannot be chosen of another file.
inline constexpr const char* kNoGrids = "has no grids with names: files ending in .vdb and .nvdb have";

/// What hl-vdb is to read: its ending, and the name of a grid; empty: the only level set, or the only grid.
struct VdbTask {
  std::string ending;
  std::string grid;
};
/// The words after the name of hl-vdb that make it read from its standard input; the rest of them, read again. Throws
/// hl::Error for words that are no such.
std::vector<std::string> wordsOf(const VdbTask& task);
VdbTask vdbTaskOf(const std::vector<std::string>& words);

/// Reads what is open as `descriptor`, from its beginning. `name` stands before errors. Throws hl::Error if hl-vdb is
/// not there, or the file cannot be used. May be called in a process with threads.
SceneModel readVdb(int descriptor, const std::string& name, const VdbTask& task, const IsolationLimits& limits,
                   const std::atomic<bool>& given_up, const std::function<void(double)>& progress);

}  // namespace hl
