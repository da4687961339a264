// Decodes a client's frame: from messages of proto/hl.proto to an edit of its scene, with the shapes built.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/editable_scene.h"

namespace hl {

/// What a client has sent ahead of a frame, by the ids it chose.
using Uploads = std::map<std::uint64_t, proto::Primitives>;

/// What is an object's item of this number so far, if it is a shape; object 0 is the world. The shape that comes in its
/// place follows on it: see makeShape.
using ShapeBefore = std::function<std::shared_ptr<const Shape>(std::uint32_t object, std::size_t item)>;

struct DecodedFrame {
  SceneEdit edit;
  std::size_t refits = 0;             ///< hierarchies that were refitted, not built
  std::vector<std::string> warnings;  ///< elements that were skipped, with counts
};

/// Takes long for large meshes: call it on a builder's thread. `progress` is told the part 0..1 of the shapes that are
/// built, and may throw to give up. Throws hl::Error, one line that names the value, for what cannot be used.
DecodedFrame decodeFrame(const proto::Frame& frame, const Uploads& uploads, const SceneLimits& limits,
                         const std::function<void(double)>& progress, const ShapeBefore& before = {});

}  // namespace hl
