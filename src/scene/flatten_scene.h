// Flattening: from objects that call each other to the shapes, bodies and joints that they place in the world. World
// frame, metres. It may take long, as it makes scaled shapes; any thread, one scene at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory_budget.h"
#include "scene/placed_shape.h"
#include "scene/scene_items.h"
#include "scene/scene_limits.h"
#include "scene/stretched_shapes.h"

namespace hl {

/// Whose scene it is, what it may take, and what of its last frame is used again.
struct FlattenContext {
  std::uint32_t session = 0;
  const SceneLimits& limits;
  const MemoryBudget& memory;  ///< what is placed is counted in it, until its last owner releases it
  const StretchedShapes& stretched_before;
  const std::vector<JointSpec>& joints_before;
};

struct FlatScene {
  PlacedShapes placed;
  StretchedShapes stretched;  ///< those that are used
};

/// Throws hl::Error if a limit is exceeded, memory is short, calls form a cycle, or a texture is missing.
FlatScene flatten(const DefinedScene& scene, const FlattenContext& context);

}  // namespace hl
