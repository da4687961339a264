// Snapshot: the immutable scene that the proxy touches, with the hierarchy over its primitives.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/primitive.h"
#include "geometry/spatial_index.h"
#include "scene/model.h"

namespace hl {

/// Which structure finds the primitives near the proxy: the paper's sphere tree, or none (every primitive is tested).
enum class HierarchyKind : std::uint8_t { kSpheres, kNone };

/// Immutable after makeSnapshot; read by any thread. Metres, world frame.
struct Snapshot {
  Model model;
  std::vector<Primitive> primitives;
  std::vector<std::uint16_t> material_of;  ///< one per primitive, or empty: all use material 0
  std::unique_ptr<const SpatialIndex> index;
  Box bounds;
  /// m: largest coordinate; distances in this scene are known to a few units in its last place.
  double extent = 0;
  std::vector<std::string> warnings;  ///< the model's, and what was skipped here

  const Material& materialOf(std::uint32_t primitive) const {
    return model.materials[material_of.empty() ? 0 : material_of[primitive]];
  }
};

/// Takes over `model`. Degenerate and non-finite elements, and indices out of range, are skipped and counted in
/// `warnings`. Allocates; never called by a real-time thread.
std::shared_ptr<const Snapshot> makeSnapshot(Model model, HierarchyKind hierarchy);

}  // namespace hl
