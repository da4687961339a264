// Shape: a model made ready for touch: its primitives and the hierarchy over them. Shared by all places where it is
// shown.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/primitives.h"
#include "geometry/spatial_index.h"
#include "scene/model.h"

namespace hl {

/// Which structure finds the primitives near the proxy: boxes with eight children each, the paper's sphere tree, or
/// none (every primitive is tested). The results are the same.
enum class HierarchyKind : std::uint8_t { kBvh, kSpheres, kNone };

/// "bvh", "spheres" or "none".
const char* nameOf(HierarchyKind hierarchy);

/// Builds the structure over `primitives`. Allocates; never called by a real-time thread.
std::unique_ptr<const SpatialIndex> makeIndex(const Primitives& primitives, HierarchyKind hierarchy);

/// Immutable after makeShape; read by any thread. Metres, object frame.
struct Shape {
  Model model;
  Primitives primitives;                   ///< of the model
  std::vector<std::uint16_t> material_of;  ///< one per primitive, or empty: all use material 0
  std::unique_ptr<const SpatialIndex> index;
  Box bounds;
  double extent = 0;                  ///< m: largest coordinate
  std::vector<std::string> warnings;  ///< the model's, and what was skipped here

  /// Memory of what says where things are: vertices, index lists and hierarchy.
  std::size_t geometryBytes() const;
  /// The same with normals, texture coordinates and material numbers; textures apart.
  std::size_t bytes() const;
  /// Number of the primitive's material in the list of the model, or of whatever stands in for it.
  std::size_t materialOf(std::uint32_t primitive) const { return material_of.empty() ? 0 : material_of[primitive]; }
};

/// Takes over the model. Degenerate and non-finite elements, and indices out of range, are skipped and counted in
/// `warnings`. Allocates; never called by a real-time thread.
std::shared_ptr<const Shape> makeShape(Model given, HierarchyKind hierarchy = HierarchyKind::kBvh);

}  // namespace hl
