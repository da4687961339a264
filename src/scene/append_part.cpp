#include "scene/append_part.h"

namespace hl {

namespace {

template <typename T>
void appendPerVertex(std::vector<T>& whole, const std::vector<T>& part, std::size_t before, std::size_t added) {
  if (whole.empty() && part.empty()) return;
  whole.resize(before, T::Zero());
  whole.insert(whole.end(), part.begin(), part.end());
  whole.resize(before + added, T::Zero());
}

}  // namespace

void repeatTexcoords(Model& model, const Vec2& factors) {
  for (Vec2& uv : model.texcoords) uv = uv.cwiseProduct(factors);
}

void appendPart(Model& whole, const Model& part, std::uint16_t material) {
  const std::size_t before = whole.positions.size();
  const auto base = static_cast<std::uint32_t>(before);
  whole.reading.add(part.reading);
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  appendPerVertex(whole.normals, part.normals, before, part.positions.size());
  appendPerVertex(whole.texcoords, part.texcoords, before, part.positions.size());
  appendAppearance(whole.appearance, whole.triangles.size(), before, part.appearance, part.triangles.size(),
                   part.positions.size());
  for (const auto& t : part.triangles) whole.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  for (const auto& s : part.segments) whole.segments.push_back({s[0] + base, s[1] + base});
  for (const std::uint32_t p : part.points) whole.points.push_back(p + base);
  whole.triangle_materials.resize(whole.triangles.size(), material);
  whole.segment_materials.resize(whole.segments.size(), material);
  whole.point_materials.resize(whole.points.size(), material);
}

}  // namespace hl
