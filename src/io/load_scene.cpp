#include "io/load_scene.h"

#include <filesystem>

#include "base/error.h"
#include "builtin.h"
#include "io/file_ending.h"
#include "io/load_scene_file.h"
#include "io/vdb_file.h"
#include "scene/idle_settings.h"

namespace hl {

SceneModel loadScene(const std::string& spec, const LoadOptions& options) {
  if (!options.grid.empty() && !readsVdb(endingOf(spec))) throw Error(spec + ": " + kNoGrids);
  if (isSceneFile(spec)) return loadSceneFile(spec, options);
  if (isBuiltinScene(spec)) return makeBuiltinWorld(spec);
  std::error_code failed;
  const auto status = std::filesystem::symlink_status(spec, failed);
  const bool looks_like_a_file = spec.find_first_of("./") != std::string::npos || std::filesystem::exists(status);
  if (!looks_like_a_file) return makeBuiltinScene(spec);  // throws, with the list
  SceneModel scene = loadModelScene(spec, options);
  leaveIdleOut(scene.model);
  return scene;
}

}  // namespace hl
