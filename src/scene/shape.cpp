#include "scene/shape.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/huge_pages.h"
#include "geometry/brute_force.h"
#include "geometry/sphere_tree.h"
#include "geometry/wide_bvh.h"

namespace hl {

namespace {

void warnSkipped(std::vector<std::string>& warnings, std::size_t count, const char* what) {
  if (count == 0) return;
  warnings.push_back("skipped " + std::to_string(count) + " " + what +
                     " that are degenerate, not finite or beyond 1e9 m");
}

// The material of each primitive; empty when the model names none.
std::vector<std::uint16_t> materialsOf(const Model& model, const Primitives& primitives) {
  if (model.triangle_materials.empty() && model.segment_materials.empty() && model.point_materials.empty()) return {};
  std::vector<std::uint16_t> result;
  result.reserve(primitives.size());
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const auto& list = primitives.kind(i) == PrimitiveKind::kTriangle  ? model.triangle_materials
                       : primitives.kind(i) == PrimitiveKind::kSegment ? model.segment_materials
                                                                       : model.point_materials;
    const std::uint32_t source = primitives.source(i);
    const std::uint16_t material = source < list.size() ? list[source] : std::uint16_t{0};
    result.push_back(material < model.materials.size() ? material : std::uint16_t{0});
  }
  return result;
}

// Rotates the vertices of each triangle so that the smallest comes first. Sorting them on reading then needs one
// unpredictable comparison instead of three. The triangle and its orientation stay the same.
void turnTriangles(Model& model) {
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  constexpr std::size_t kGrain = 4096;
  const auto& p = model.positions;
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(p[a].data(), p[a].data() + 3, p[b].data(), p[b].data() + 3);
  };
  const auto turn = [&](std::array<std::uint32_t, 3>& t) {
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t index) { return index >= p.size(); })) return;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end(), less), t.end());
  };
  oneapi::tbb::parallel_for(Range(0, model.triangles.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) turn(model.triangles[i]);
  });
}

template <typename T>
std::size_t bytesOf(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

// Memory of the smallest shape: itself, its pointers, and the overhead of malloc() for each of its lists.
constexpr std::size_t kSmallest = 2048;

// Each of a hierarchy's two lists may end within a huge page.
std::size_t hierarchyBytes(std::size_t bytes) {
  return bytes < HugePages::kPage ? bytes : bytes + 2 * HugePages::kPage;
}

std::size_t meshBytes(const Model& model) {
  return bytesOf(model.positions) + bytesOf(model.triangles) + bytesOf(model.segments) + bytesOf(model.points);
}

std::size_t surfaceBytes(const Model& model) {
  return bytesOf(model.normals) + bytesOf(model.texcoords) + bytesOf(model.triangle_materials) +
         bytesOf(model.segment_materials) + bytesOf(model.point_materials) + model.appearance.bytes();
}

bool sameButTurned(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return a == b || a == std::array{b[1], b[2], b[0]} || a == std::array{b[2], b[0], b[1]};
}

std::uint64_t nextGeometry() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void setBounds(Shape& shape) {
  shape.bounds = shape.source ? shape.source->bounds() : shape.primitives.bounds();
  shape.extent =
      shape.bounds.empty() ? 0 : shape.bounds.min.cwiseAbs().cwiseMax(shape.bounds.max.cwiseAbs()).maxCoeff();
}

// The shape without its hierarchy.
std::shared_ptr<Shape> shapeOf(Model given) {
  auto shape = std::make_shared<Shape>();
  shape->geometry = shape->mesh = nextGeometry();
  shape->model = std::move(given);
  turnTriangles(shape->model);
  shape->model.positions.shrink_to_fit();
  shape->model.triangles.shrink_to_fit();
  const Model& model = shape->model;
  shape->primitives = Primitives(viewOf(model));
  const Primitives& primitives = shape->primitives;
  shape->warnings = model.warnings;
  warnSkipped(shape->warnings, primitives.refused().triangles, "triangles");
  warnSkipped(shape->warnings, primitives.refused().segments, "segments");
  warnSkipped(shape->warnings, primitives.refused().points, "points");
  shape->material_of = materialsOf(model, primitives);
  setBounds(*shape);
  return shape;
}

template <typename T>
void layInHugePages(const std::vector<T>& list) {
  HugePages::collapse(list.data(), list.size() * sizeof(T));
}

// Moves the vertices to huge pages. A built shape lives long enough for that; a refitted one is replaced in the next
// frame.
void buildIndex(Shape& shape, HierarchyKind hierarchy) {
  layInHugePages(shape.model.positions);
  layInHugePages(shape.model.triangles);
  shape.hierarchy = hierarchy;
  shape.index = makeIndex(shape.primitives, hierarchy);
}

}  // namespace

const char* nameOf(HierarchyKind hierarchy) {
  switch (hierarchy) {
    case HierarchyKind::kBvh:
      return "bvh";
    case HierarchyKind::kSpheres:
      return "spheres";
    case HierarchyKind::kNone:
      break;
  }
  return "none";
}

std::unique_ptr<const SpatialIndex> makeIndex(const Primitives& primitives, HierarchyKind hierarchy) {
  switch (hierarchy) {
    case HierarchyKind::kBvh:
      return std::make_unique<WideBvh>(WideBvh::build(primitives));
    case HierarchyKind::kSpheres:
      return std::make_unique<SphereTree>(SphereTree::build(primitives));
    case HierarchyKind::kNone:
      break;
  }
  return std::make_unique<BruteForceIndex>(primitives.size());
}

std::shared_ptr<const Shape> makeShape(Model given, HierarchyKind hierarchy) {
  const auto shape = shapeOf(std::move(given));
  buildIndex(*shape, hierarchy);
  return shape;
}

std::shared_ptr<const Shape> makeShape(std::shared_ptr<const PrimitiveSource> source, const Material& material,
                                       std::vector<Texture> textures, const Vec2& repeat, Appearance appearance) {
  auto shape = std::make_shared<Shape>();
  shape->geometry = shape->mesh = nextGeometry();
  shape->model.materials = {material};
  shape->model.textures = std::move(textures);
  shape->model.appearance = std::move(appearance);
  shape->source = std::move(source);
  shape->repeat = repeat;
  shape->index = shape->source->makeIndex();
  setBounds(*shape);
  return shape;
}

std::shared_ptr<const Shape> placedShape(const Shape& shape, const Mat3& linear, const Vec3& offset) {
  return makeShape(shape.source->placed(linear, offset), shape.model.materials.front(), shape.model.textures,
                   shape.repeat, shape.model.appearance);
}

// The vertices of a triangle may be rotated differently, as the rotation depends on their positions.
bool isSameMesh(const Shape& a, const Shape& b) {
  const Model &p = a.model, &q = b.model;
  return !a.source && !b.source && p.positions.size() == q.positions.size() && p.segments == q.segments &&
         p.points == q.points &&
         std::equal(p.triangles.begin(), p.triangles.end(), q.triangles.begin(), q.triangles.end(), sameButTurned);
}

std::shared_ptr<const Shape> makeShape(Model given, const Shape& before) {
  const auto shape = shapeOf(std::move(given));
  const bool bent = isSameMesh(*shape, before);
  if (bent) shape->mesh = before.mesh;
  const auto* const tree = dynamic_cast<const WideBvh*>(before.index.get());
  if (tree == nullptr || !bent || !shape->primitives.numberedAs(before.primitives)) {
    buildIndex(*shape, before.hierarchy);
    return shape;
  }
  auto refitted = std::make_unique<const WideBvh>(tree->refit(shape->primitives));
  shape->cost_ratio = refitted->costRatio();
  shape->before = before.geometry;
  shape->index = std::move(refitted);
  return shape;
}

std::shared_ptr<const Shape> withTree(const Shape& shape, const WideBvh& tree) {
  const auto made = shapeOf(shape.model);
  made->geometry = shape.geometry;
  made->mesh = shape.mesh;
  made->index = std::make_unique<const WideBvh>(tree.refit(made->primitives));
  return made;
}

std::shared_ptr<const Shape> shapeOfElements(Model model, std::vector<std::uint32_t> elements, const WideBvh* tree) {
  const auto made = shapeOf(std::move(model));
  made->primitives = Primitives(viewOf(made->model), std::move(elements));
  made->material_of = materialsOf(made->model, made->primitives);
  made->index = std::make_unique<const WideBvh>(tree != nullptr ? tree->refit(made->primitives)
                                                                : WideBvh::build(made->primitives));
  setBounds(*made);
  return made;
}

MeshView viewOf(const Model& model) { return {model.positions, model.triangles, model.segments, model.points}; }

std::array<std::uint32_t, 3> verticesOf(const Shape& shape, ElementId primitive) {
  const Model& model = shape.model;
  const std::uint32_t source = shape.primitives.source(primitive);
  switch (shape.primitives.elementKind(primitive)) {
    case PrimitiveKind::kTriangle:
      return model.triangles[source];
    case PrimitiveKind::kSegment:
      return {model.segments[source][0], model.segments[source][1], model.segments[source][1]};
    case PrimitiveKind::kPoint:
      break;
  }
  return {model.points[source], model.points[source], model.points[source]};
}

std::shared_ptr<const Shape> rebuilt(const Shape& worn) {
  const auto shape = shapeOf(worn.model);
  buildIndex(*shape, worn.hierarchy);
  shape->geometry = worn.geometry;
  shape->mesh = worn.mesh;
  return shape;
}

std::size_t bytesToMake(const ModelCounts& counts) {
  // The hierarchy takes 19 bytes per triangle at ten million, and 60 while it is built (the peak of the process).
  constexpr std::size_t kWhileBuilt = 64;
  const std::size_t elements = counts.triangles + counts.segments + counts.points;
  return kSmallest + sizeof(Vec3) * (counts.vertices + counts.normals) + sizeof(Vec2) * counts.texcoords +
         3 * sizeof(std::uint32_t) * counts.triangles + 2 * sizeof(std::uint32_t) * counts.segments +
         sizeof(std::uint32_t) * counts.points + sizeof(Rgb) * counts.colours + hierarchyBytes(kWhileBuilt * elements);
}

std::size_t bytesToMake(const Model& model) {
  const ModelCounts counts{model.positions.size(), model.normals.size(),  model.texcoords.size(),
                           model.triangles.size(), model.segments.size(), model.points.size()};
  return bytesToMake(counts) + bytesOf(model.triangle_materials) + bytesOf(model.segment_materials) +
         bytesOf(model.point_materials) + model.appearance.bytes();
}

std::size_t Shape::geometryBytes() const {
  return meshBytes(model) + primitives.bytes() + (source ? source->bytes() : 0) + shared().bytes + index->stats().bytes;
}

std::size_t Shape::bytes() const {
  return kSmallest + meshBytes(model) + surfaceBytes(model) + bytesOf(material_of) + primitives.bytes() +
         (source ? source->bytes() : 0) + hierarchyBytes(index->stats().bytes);
}

}  // namespace hl
