// What every fuzzer asks of a scene that was taken: it can be touched.
#pragma once

#include "require.h"
#include "scene/scene_model.h"

namespace hl::fuzz {

/// A finger goes through the middle of the scene while it moves. Aborts when the proxy is lost.
void touch(const Snapshot& snapshot);

}  // namespace hl::fuzz
