// From the options of a scene to a snapshot that can be touched, with what there is to say of it on stderr.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "scene/scene_model.h"
#include "scene/snapshot.h"
#include "scene_options.h"

namespace hl {

/// Loads, scales and builds; progress of long loads and warnings go to stderr. Throws hl::Error.
std::shared_ptr<const Snapshot> loadSnapshot(const SceneOptions& options);
/// Throws hl::Error, with `name` in front, for a model that takes more than `there_bytes` of memory to make.
void requireMemory(const SceneModel& scene, const std::string& name, std::uint64_t there_bytes);

}  // namespace hl
