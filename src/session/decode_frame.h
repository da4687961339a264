// Decodes a client's frame: from messages of proto/hl.proto to an edit of its scene, with the shapes built.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/editable_scene.h"
#include "session/frame_objects.h"
#include "session/frame_shapes.h"
#include "session/message_size.h"

namespace hl {

struct DecodedFrame {
  SceneEdit edit;
  std::optional<Vec3> gravity_m_s2;   ///< absent: unchanged
  std::size_t refits = 0;             ///< hierarchies that were refitted, not built
  std::vector<std::string> warnings;  ///< elements that were skipped, with counts; the first few items
  MemoryShare memory;                 ///< of the edit's lists, beside what its objects take
};

/// Takes long for large meshes: call it on a builder's thread. `progress` is given the part 0..1 of the shapes that are
/// built, and may throw to give up. What is made is counted against `memory` before it is, and until nobody has it any
/// more. The parts of an upload that is used are one part afterwards. Throws hl::Error, one line that names the value,
/// for what cannot be used, and when there is no memory for it.
DecodedFrame decodeFrame(const proto::Frame& frame, Uploads& uploads, const SceneLimits& limits,
                         const MemoryBudget& memory, const std::function<void(double)>& progress,
                         const ItemsBefore& before = {});

}  // namespace hl
