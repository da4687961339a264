// From the options of a scene to a snapshot that can be touched, with what there is to say of it on stderr.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "scene/scene_model.h"
#include "scene/snapshot.h"
#include "scene_options.h"

namespace hl {

/// Whether other files may take the place of the scene later. What is said of CAD files may be meant for these.
enum class LaterFiles : std::uint8_t { kNone, kMayCome };

/// Loads, scales and builds; progress of long loads and warnings go to stderr. Throws hl::Error, also where no file of
/// the scene is what the options are for.
std::shared_ptr<const Snapshot> loadSnapshot(const SceneOptions& options, LaterFiles later = LaterFiles::kNone);
/// Throws hl::Error, with `name` in front, for a model that takes more than `there_bytes` of memory to make.
void requireMemory(const SceneModel& scene, const std::string& name, std::uint64_t there_bytes);

}  // namespace hl
