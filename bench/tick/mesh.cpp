#include "tick/mesh.h"

namespace hl::bench {

Mesh trianglesOf(const Shape& shape) {
  const Model& model = shape.model;
  Mesh mesh{model.positions, {}};
  mesh.triangles.reserve(model.triangles.size());
  for (const auto& t : model.triangles) {
    const auto outside = [&](std::uint32_t index) { return index >= model.positions.size(); };
    if (outside(t[0]) || outside(t[1]) || outside(t[2])) continue;
    Primitive sound;
    if (makeTriangle(model.positions[t[0]], model.positions[t[1]], model.positions[t[2]], 0, sound)) {
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

double meanEdge_m(const Mesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) sum += (mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm();
  }
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace hl::bench
