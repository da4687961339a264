// Shape: a model prepared for contact queries: its primitives and the hierarchy over them. Shared by all instances of
// it.
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

/// The structure that finds the primitives near the proxy: a hierarchy of boxes with eight children each, the paper's
/// sphere tree, or none (every primitive is tested). The results are the same.
enum class HierarchyKind : std::uint8_t { kBvh, kSpheres, kNone };

/// "bvh", "spheres" or "none".
const char* nameOf(HierarchyKind hierarchy);

/// Builds the structure over `primitives`. Allocates; never called by a real-time thread.
std::unique_ptr<const SpatialIndex> makeIndex(const Primitives& primitives, HierarchyKind hierarchy);

/// A mesh, or a surface that computes its primitives on request. Immutable after makeShape; read by any thread. Metres,
/// object frame.
struct Shape {
  Model model;                                    ///< no vertices if there is a source
  Primitives primitives;                          ///< primitives of the model
  std::shared_ptr<const PrimitiveSource> source;  ///< null: the shape is a mesh
  Vec2 repeat = Vec2::Ones();                     ///< texture coordinates of a source are multiplied by it
  std::vector<std::uint16_t> material_of;         ///< one per primitive, or empty: all use material 0
  HierarchyKind hierarchy = HierarchyKind::kBvh;
  std::unique_ptr<const SpatialIndex> index;
  double cost_ratio = 1;       ///< query cost of a refitted hierarchy over that of a new one: see WideBvh::costRatio
  std::uint64_t geometry = 0;  ///< > 0; only copies with another hierarchy have the same number
  std::uint64_t before = 0;    ///< geometry of the shape that was refitted; 0: the hierarchy was built
  std::uint64_t mesh = 0;      ///< > 0; shapes with the same number are one mesh, deformed: see isSameMesh()
  Box bounds;
  double extent = 0;                  ///< m: largest absolute coordinate
  std::vector<std::string> warnings;  ///< warnings of the model, and skipped elements

  /// Memory of the geometry: vertices, index lists and hierarchy, or what a source has; also what it shares.
  std::size_t geometryBytes() const;
  /// As geometryBytes(), plus normals, texture coordinates, material numbers and the shape itself; without textures and
  /// what it shares.
  std::size_t bytes() const;
  SharedMemory shared() const { return source ? source->shared() : SharedMemory{}; }
  // The primitives, of a mesh or of a source; RT-safe. `id` < count().
  std::uint64_t elements() const { return source ? source->triangles() : primitives.size(); }  ///< of a source: about
  ElementId count() const { return source ? source->count() : primitives.size(); }
  Primitive primitive(ElementId id) const { return source ? primitiveOf(*source, id) : primitives[id]; }
  PrimitiveKind kind(ElementId id) const { return source ? source->kind() : primitives.kind(id); }
  /// Whether its triangles have vertex normals, or the points of its source normals.
  bool hasNormals() const { return source || !model.normals.empty(); }
  /// Whether normals identify the outside; else the opposite of each is as good.
  bool hasOutside() const { return !source || source->hasOutside(); }
  /// The vertex normal of a triangle, or of a point of a source; requires hasNormals(). `sorted`: number among the
  /// sorted vertices.
  Vec3 cornerNormal(ElementId id, const Primitive& triangle, std::size_t sorted) const {
    if (source) return source->trueNormal(id, triangle.vertex[sorted]);
    return model.normals[model.triangles[triangle.source][triangle.order[sorted]]];
  }
  bool hasTexcoords() const { return source ? source->hasTexcoords() : !model.texcoords.empty(); }
  /// Texture coordinates of a vertex of a triangle; requires hasTexcoords(). `given`: Primitive::source; `corner`: the
  /// vertex's number in Primitive::order.
  Vec2 cornerTexcoord(ElementId given, std::size_t corner) const {
    if (source) return source->texcoord(given, corner).cwiseProduct(repeat);
    return model.texcoords[model.triangles[given][corner]];
  }
  /// Number of the primitive's material in the model's list, or in the list that replaces it (Surfaces).
  std::size_t materialOf(ElementId id) const { return material_of.empty() ? 0 : material_of[id]; }
};

/// Takes ownership of the model. Elements that are degenerate, non-finite or have an index out of range are skipped and
/// counted in `warnings`. Allocates; never called by a real-time thread.
std::shared_ptr<const Shape> makeShape(Model given, HierarchyKind hierarchy = HierarchyKind::kBvh);

/// A surface that is not a mesh, with one material and the textures that it uses. `repeat`: factors of its texture
/// coordinates. `appearance`: the first of its paints is that of all triangles. Allocates; never called by a real-time
/// thread.
std::shared_ptr<const Shape> makeShape(std::shared_ptr<const PrimitiveSource> source, const Material& material = {},
                                       std::vector<Texture> textures = {}, const Vec2& repeat = Vec2::Ones(),
                                       Appearance appearance = {});

/// A surface that is not a mesh, moved by x -> linear x + offset. Throws hl::Error if it cannot be.
std::shared_ptr<const Shape> placedShape(const Shape& shape, const Mat3& linear, const Vec3& offset);

/// Whether one is the other with moved vertices: they have the same index lists; skipped elements do not matter.
bool isSameMesh(const Shape& a, const Shape& b);

/// As makeShape(), for a shape that replaces `before`. If both are the same mesh and skip the same elements, a wide
/// hierarchy is refitted, which is nine times as fast as building it. Otherwise a hierarchy of the same kind is built.
std::shared_ptr<const Shape> makeShape(Model given, const Shape& before);

/// For deforming meshes (mesh_motion.h). withTree(): the same mesh with a refitted copy of `tree`; it keeps the numbers
/// `geometry` and `mesh`. shapeOfElements(): a shape of the listed elements only (see Primitives), with a refitted copy
/// of `tree`, or a new hierarchy if `tree` is null. Both allocate.
std::shared_ptr<const Shape> withTree(const Shape& shape, const WideBvh& tree);
std::shared_ptr<const Shape> shapeOfElements(Model model, std::vector<std::uint32_t> elements, const WideBvh* tree);

MeshView viewOf(const Model& model);
/// Vertex numbers of a primitive, in the given order; the last is repeated if there are fewer than three. RT-safe.
std::array<std::uint32_t, 3> verticesOf(const Shape& shape, ElementId primitive);

/// The sizes of a model that does not exist yet.
struct ModelCounts {
  std::size_t vertices = 0, normals = 0, texcoords = 0, triangles = 0, segments = 0, points = 0, colours = 0;
};

/// Upper bound of the memory that makeShape() uses for a model, including the model itself, from the sizes alone.
std::size_t bytesToMake(const ModelCounts& counts);
std::size_t bytesToMake(const Model& model);

/// Calls `make` and counts the memory of the shape that it returns, from before the call until the last owner releases
/// the shape: first as `bytes_to_make`, then as its actual size. If there is no room, throws hl::Error and does not
/// call `make`.
template <typename Make>
std::shared_ptr<const Shape> makeCounted(const MemoryBudget& budget, std::size_t bytes_to_make, const Make& make) {
  MemoryShare memory(budget);
  memory.take(bytes_to_make);
  std::shared_ptr<const Shape> shape = make();
  memory.set(shape->bytes());
  return withShare(std::move(shape), std::move(memory));
}

/// With a larger cost ratio a hierarchy should be rebuilt: a query enters twice as many boxes as when it was built.
inline constexpr double kMaxCostRatio = 2;
/// The same geometry with a newly built hierarchy; query results are identical bit by bit. Slow.
std::shared_ptr<const Shape> rebuilt(const Shape& worn);

}  // namespace hl
