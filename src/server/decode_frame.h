// Decodes a client's frame: from messages of proto/hl.proto to an edit of its scene, with the shapes built.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scene/editable_scene.h"

namespace hl {

/// What a client has sent ahead of a frame, by the ids it chose.
using Uploads = std::map<std::uint64_t, proto::Primitives>;

/// The items that an object has so far, null where there is none; object 0 is the world. A shape that comes in the
/// place of another follows on it: see makeShape.
using ItemsBefore = std::function<const SceneItems*(std::uint32_t object)>;

struct DecodedFrame {
  SceneEdit edit;
  std::size_t refits = 0;             ///< hierarchies that were refitted, not built
  std::vector<std::string> warnings;  ///< elements that were skipped, with counts
};

/// Takes long for large meshes: call it on a builder's thread. `progress` is told the part 0..1 of the shapes that are
/// built, and may throw to give up. What the shapes take is added to `memory`, which may throw. Throws hl::Error, one
/// line that names the value, for what cannot be used.
DecodedFrame decodeFrame(const proto::Frame& frame, const Uploads& uploads, const SceneLimits& limits,
                         MemoryShare& memory, const std::function<void(double)>& progress,
                         const ItemsBefore& before = {});

}  // namespace hl
