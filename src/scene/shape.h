// Shape: a model made ready for touch: its primitives and the hierarchy over them. Shared by all places where it is
// shown.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "geometry/primitive_source.h"
#include "geometry/primitives.h"
#include "geometry/spatial_index.h"
#include "scene/model.h"

namespace hl {

class WideBvh;

/// Which structure finds the primitives near the proxy: boxes with eight children each, the paper's sphere tree, or
/// none (every primitive is tested). The results are the same.
enum class HierarchyKind : std::uint8_t { kBvh, kSpheres, kNone };

/// "bvh", "spheres" or "none".
const char* nameOf(HierarchyKind hierarchy);

/// Builds the structure over `primitives`. Allocates; never called by a real-time thread.
std::unique_ptr<const SpatialIndex> makeIndex(const Primitives& primitives, HierarchyKind hierarchy);

/// A mesh, or a surface that makes its primitives on request. Immutable after makeShape; read by any thread. Metres,
/// object frame.
struct Shape {
  Model model;                                    ///< without vertices where there is a source
  Primitives primitives;                          ///< of the model
  std::shared_ptr<const PrimitiveSource> source;  ///< null: it is a mesh
  std::vector<std::uint16_t> material_of;         ///< one per primitive, or empty: all use material 0
  HierarchyKind hierarchy = HierarchyKind::kBvh;
  std::unique_ptr<const SpatialIndex> index;
  double cost_ratio = 1;       ///< of a refitted hierarchy: see WideBvh::costRatio
  std::uint64_t geometry = 0;  ///< above 0; another shape has the same number only when it was rebuilt from this one
  std::uint64_t before = 0;    ///< geometry of the shape that the hierarchy was refitted from; 0: it was built
  std::uint64_t mesh = 0;      ///< above 0; shapes with the same number are one mesh, deformed: see isSameMesh()
  Box bounds;
  double extent = 0;                  ///< m: largest coordinate
  std::vector<std::string> warnings;  ///< the model's, and what was skipped here

  /// Memory of what says where things are: vertices, index lists and hierarchy.
  std::size_t geometryBytes() const;
  /// The same with normals, texture coordinates, material numbers and the shape itself; textures apart.
  std::size_t bytes() const;
  // Its primitives, of the mesh or the source; RT-safe. `id` < count().
  ElementId count() const { return source ? source->count() : primitives.size(); }
  Primitive primitive(ElementId id) const { return source ? primitiveOf(*source, id) : primitives[id]; }
  PrimitiveKind kind(ElementId id) const { return source ? PrimitiveKind::kTriangle : primitives.kind(id); }
  /// Whether its triangles have normals at their corners.
  bool hasNormals() const { return source || !model.normals.empty(); }
  /// The normal at a corner of one of its triangles, of a shape that has them.
  Vec3 cornerNormal(ElementId id, const Primitive& triangle, std::size_t sorted) const {
    if (source) return source->trueNormal(id, triangle.vertex[sorted]);
    return model.normals[model.triangles[triangle.source][triangle.order[sorted]]];
  }
  /// Number of the primitive's material in the list of the model, or of whatever stands in for it.
  std::size_t materialOf(ElementId id) const { return material_of.empty() ? 0 : material_of[id]; }
};

/// Takes over the model. Degenerate and non-finite elements, and indices out of range, are skipped and counted in
/// `warnings`. Allocates; never called by a real-time thread.
std::shared_ptr<const Shape> makeShape(Model given, HierarchyKind hierarchy = HierarchyKind::kBvh);

/// A surface that is no mesh, all of one material. Allocates; never called by a real-time thread.
std::shared_ptr<const Shape> makeShape(std::shared_ptr<const PrimitiveSource> source, const Material& material = {});

/// Whether one is the other with its vertices moved: the same index lists, whatever of them is skipped.
bool isSameMesh(const Shape& a, const Shape& b);

/// The same for what follows on `before`. Where both are the same mesh and skip the same elements, a wide hierarchy is
/// refitted: that is nine times as fast as building it. Else it is built, of the same kind.
std::shared_ptr<const Shape> makeShape(Model given, const Shape& before);

/// For a mesh in motion (mesh_motion.h): the same mesh with the same vertices under another tree, refitted; `shape` is
/// numbered as what the tree was built for. And a shape of some elements alone, as Primitives has them, under that
/// tree, or under a new one where there is none. Allocate.
std::shared_ptr<const Shape> withTree(const Shape& shape, const WideBvh& tree);
std::shared_ptr<const Shape> shapeOfElements(Model model, std::vector<std::uint32_t> elements, const WideBvh* tree);

MeshView viewOf(const Model& model);
/// Numbers of the vertices of a primitive, in the order given; the last is repeated where there are fewer than three.
/// RT-safe.
std::array<std::uint32_t, 3> verticesOf(const Shape& shape, ElementId primitive);

/// How much a model that is not there yet will have.
struct ModelCounts {
  std::size_t vertices = 0, normals = 0, texcoords = 0, triangles = 0, segments = 0, points = 0;
};

/// Memory that makeShape() takes of a model at most, the model's own among it, by its numbers alone.
std::size_t bytesToMake(const ModelCounts& counts);
std::size_t bytesToMake(const Model& model);

/// What `make` makes, a shape, is counted from before it is made until nobody has it any more: first as
/// `bytes_to_make`, then as what it takes. Throws hl::Error, and makes nothing, when there is no room.
template <typename Make>
std::shared_ptr<const Shape> makeCounted(const MemoryBudget& budget, std::size_t bytes_to_make, const Make& make) {
  MemoryShare memory(budget);
  memory.take(bytes_to_make);
  std::shared_ptr<const Shape> shape = make();
  memory.set(shape->bytes());
  return withShare(std::move(shape), std::move(memory));
}

/// Beyond this wear a hierarchy should be built anew: a query enters twice as many boxes as it did then.
inline constexpr double kMaxCostRatio = 2;
/// The same geometry with a hierarchy that is built for it: the same answers to the bit. Takes long.
std::shared_ptr<const Shape> rebuilt(const Shape& worn);

}  // namespace hl
