// FleetPlan: the tasks of a sweep. Each is one trace, named by the SHA-256 of all that its result depends on: the files
// of the scene and of the path, the options, the seed, and the program itself. So a result that is there is the result.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fleet/sweep_file.h"

namespace hl {

/// A scene or a path, as the sweep's file names it.
struct FleetSource {
  std::string name;
  std::string sha256;  ///< of its files and their names; of the name, if it is a built-in scene
};

struct FleetTask {
  std::string name;                              ///< 64 hexadecimal digits
  std::size_t scene = 0, path = 0, options = 0;  ///< places in the lists of the plan
  std::int64_t seed = -1;                        ///< -1: none
};

struct FleetPlan {
  std::string program;  ///< what makes the results: version and SHA-256
  std::vector<FleetSource> scenes, paths;
  std::vector<SweepOptions> options;
  bool rows = false;
  std::vector<FleetTask> tasks;  ///< scenes, paths, options, seeds: the last changes first
  std::string name;              ///< SHA-256 of the names of all tasks

  /// What `hl trace` would be called with, without --out.
  std::vector<std::string> wordsOf(const FleetTask& task) const;
};

/// Of a scene and of a path, as they are named, with their files as they are now. Throw hl::Error for a file that
/// cannot be read.
FleetSource sceneSource(const std::string& name);
FleetSource pathSource(const std::string& name);

/// Reads all files that the sweep names, relative to the current folder. Throws hl::Error for one that cannot be read.
/// `version`: of this program, whose own file is read too.
FleetPlan makeFleetPlan(const SweepFile& sweep, const std::string& version);

}  // namespace hl
