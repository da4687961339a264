#include "scene/split_model.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

// Where a part begins in the lists of the whole.
struct PartBegin {
  std::size_t vertex = 0, triangle = 0, segment = 0;

  void pass(const ModelPart& part) {
    vertex += part.vertices;
    triangle += part.triangles;
    segment += part.segments;
  }
};

template <typename Item>
std::vector<Item> slice(const std::vector<Item>& list, std::size_t begin, std::size_t count) {
  if (list.empty()) return {};
  const auto first = list.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

template <typename Element>
bool useVertices(const std::vector<Element>& elements, std::size_t begin, std::size_t count, std::size_t first_vertex,
                 std::size_t vertices) {
  const auto first = elements.begin() + static_cast<std::ptrdiff_t>(begin);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(count), [&](const Element& element) {
    return std::all_of(element.begin(), element.end(),
                       [&](std::uint32_t v) { return v >= first_vertex && v - first_vertex < vertices; });
  });
}

Model sliceOf(const Model& whole, const ModelPart& part, const PartBegin& at) {
  Model model;
  model.name = part.name;
  model.positions = slice(whole.positions, at.vertex, part.vertices);
  model.normals = slice(whole.normals, at.vertex, part.vertices);
  model.texcoords = slice(whole.texcoords, at.vertex, part.vertices);
  model.triangles = slice(whole.triangles, at.triangle, part.triangles);
  model.segments = slice(whole.segments, at.segment, part.segments);
  model.materials = whole.materials;
  model.appearance.pictures = whole.appearance.pictures;
  model.appearance.paints = whole.appearance.paints;
  model.appearance.triangle_paints = slice(whole.appearance.triangle_paints, at.triangle, part.triangles);
  model.appearance.vertex_colours = slice(whole.appearance.vertex_colours, at.vertex, part.vertices);
  model.textures = whole.textures;
  const auto moved = [&](auto& elements) {
    for (auto& element : elements) {
      for (std::uint32_t& v : element) v -= static_cast<std::uint32_t>(at.vertex);
    }
  };
  moved(model.triangles);
  moved(model.segments);
  return model;
}

}  // namespace

void checkParts(const Model& model) {
  if (model.parts.empty()) return;
  constexpr const char* kBrokenParts = "the objects of a model make no sense";
  const auto left = [&](const PartBegin& at) {
    return PartBegin{model.positions.size() - at.vertex, model.triangles.size() - at.triangle,
                     model.segments.size() - at.segment};
  };
  PartBegin at;
  for (const ModelPart& part : model.parts) {
    const PartBegin most = left(at);
    if (part.vertices > most.vertex || part.triangles > most.triangle || part.segments > most.segment ||
        !useVertices(model.triangles, at.triangle, part.triangles, at.vertex, part.vertices) ||
        !useVertices(model.segments, at.segment, part.segments, at.vertex, part.vertices))
      throw Error(kBrokenParts);
    at.pass(part);
  }
  const PartBegin rest = left(at);
  const bool materials =
      !model.triangle_materials.empty() || !model.segment_materials.empty() || !model.point_materials.empty();
  if (rest.vertex + rest.triangle + rest.segment + model.points.size() > 0 || materials) throw Error(kBrokenParts);
}

void asOneObject(Model& model) {
  const auto has_colour = [](const ModelPart& part) { return part.colour.has_value(); };
  if (std::any_of(model.parts.begin(), model.parts.end(), has_colour)) {
    Appearance& appearance = model.appearance;
    appearance.paints = {Paint{}};
    appearance.triangle_paints.clear();
    for (const ModelPart& part : model.parts) {
      if (part.colour) appearance.paints.push_back({*part.colour, {}});
      const std::size_t paint = part.colour ? appearance.paints.size() - 1 : 0;
      appearance.triangle_paints.resize(appearance.triangle_paints.size() + part.triangles,
                                        static_cast<std::uint16_t>(paint));
    }
  }
  model.parts.clear();
}

std::vector<Model> splitModel(Model whole) {
  std::vector<Model> models;
  PartBegin at;
  for (const ModelPart& part : whole.parts) {
    models.push_back(sliceOf(whole, part, at));
    at.pass(part);
  }
  models.front().warnings = std::move(whole.warnings);
  models.front().reading = whole.reading;
  return models;
}

}  // namespace hl
