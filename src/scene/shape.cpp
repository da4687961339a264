#include "scene/shape.h"

#include <algorithm>
#include <utility>

#include "geometry/brute_force.h"
#include "geometry/sphere_tree.h"
#include "geometry/wide_bvh.h"

namespace hl {

namespace {

// Calls make(vertices..., source, primitive) for one list of elements; returns how many were refused.
template <typename List, typename Make>
std::size_t addElements(const Model& model, const List& list, std::vector<Primitive>& primitives, Make make) {
  std::size_t skipped = 0;
  for (std::uint32_t source = 0; source < list.size(); ++source) {
    Primitive primitive;
    if (make(model, list[source], source, primitive)) {
      primitives.push_back(primitive);
    } else {
      ++skipped;
    }
  }
  return skipped;
}

bool inRange(const Model& model, std::uint32_t index) { return index < model.positions.size(); }

bool fromTriangle(const Model& model, const std::array<std::uint32_t, 3>& t, std::uint32_t source, Primitive& out) {
  return inRange(model, t[0]) && inRange(model, t[1]) && inRange(model, t[2]) &&
         makeTriangle(model.positions[t[0]], model.positions[t[1]], model.positions[t[2]], source, out);
}

bool fromSegment(const Model& model, const std::array<std::uint32_t, 2>& s, std::uint32_t source, Primitive& out) {
  return inRange(model, s[0]) && inRange(model, s[1]) &&
         makeSegment(model.positions[s[0]], model.positions[s[1]], source, out);
}

bool fromPoint(const Model& model, std::uint32_t point, std::uint32_t source, Primitive& out) {
  return inRange(model, point) && makePoint(model.positions[point], source, out);
}

void warnSkipped(std::vector<std::string>& warnings, std::size_t count, const char* what) {
  if (count > 0) warnings.push_back("skipped " + std::to_string(count) + " degenerate or non-finite " + what);
}

// The material of each primitive; empty when the model names none.
std::vector<std::uint16_t> materialsOf(const Model& model, const std::vector<Primitive>& primitives) {
  if (model.triangle_materials.empty() && model.segment_materials.empty() && model.point_materials.empty()) return {};
  std::vector<std::uint16_t> result;
  result.reserve(primitives.size());
  for (const Primitive& primitive : primitives) {
    const auto& list = primitive.kind == PrimitiveKind::kTriangle  ? model.triangle_materials
                       : primitive.kind == PrimitiveKind::kSegment ? model.segment_materials
                                                                   : model.point_materials;
    const std::uint16_t material = primitive.source < list.size() ? list[primitive.source] : std::uint16_t{0};
    result.push_back(material < model.materials.size() ? material : std::uint16_t{0});
  }
  return result;
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

std::unique_ptr<const SpatialIndex> makeIndex(std::span<const Primitive> primitives, HierarchyKind hierarchy) {
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

std::shared_ptr<const Shape> makeShape(Model model, HierarchyKind hierarchy) {
  auto shape = std::make_shared<Shape>();
  auto& primitives = shape->primitives;
  primitives.reserve(model.elements());
  shape->warnings = model.warnings;
  warnSkipped(shape->warnings, addElements(model, model.triangles, primitives, fromTriangle), "triangles");
  warnSkipped(shape->warnings, addElements(model, model.segments, primitives, fromSegment), "segments");
  warnSkipped(shape->warnings, addElements(model, model.points, primitives, fromPoint), "points");
  for (const Primitive& primitive : primitives) {
    for (const Vec3& vertex : primitive.vertex) shape->bounds.extend(vertex);
  }
  shape->material_of = materialsOf(model, primitives);
  if (!shape->bounds.empty()) {
    shape->extent = shape->bounds.min.cwiseAbs().cwiseMax(shape->bounds.max.cwiseAbs()).maxCoeff();
  }
  shape->index = makeIndex(primitives, hierarchy);
  shape->model = std::move(model);
  return shape;
}

}  // namespace hl
