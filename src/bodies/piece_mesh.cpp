#include "bodies/piece_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bodies/places.h"

namespace hl {

namespace {

// Of the cells along the longest side, from one trial to the next.
constexpr double kCoarser = 0.8;
constexpr double kFinestCells = 256;

Corners leastFirst(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Each once, ascending; without those that have a corner twice.
void tidy(std::vector<Corners>& triangles) {
  std::erase_if(triangles, [](const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  std::transform(triangles.begin(), triangles.end(), triangles.begin(), leastFirst);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

double sixfoldVolume(const PieceMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& origin = mesh.vertices.front();
    volume += (mesh.vertices[a] - origin).dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin));
  }
  return volume;
}

// Of a grid whose cells have this side.
PieceMesh onGrid(const PieceMesh& mesh, const Vec3& low, double side) {
  std::map<std::array<std::int64_t, 3>, std::uint32_t> cells;
  PieceMesh coarse;
  std::vector<std::uint32_t> cell_of;
  std::vector<double> counts;
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 at = (vertex - low) / side;
    const std::array<std::int64_t, 3> cell{std::llround(at.x()), std::llround(at.y()), std::llround(at.z())};
    const std::uint32_t number = cells.try_emplace(cell, static_cast<std::uint32_t>(cells.size())).first->second;
    if (number == counts.size()) {
      coarse.vertices.emplace_back(Vec3::Zero());
      counts.push_back(0);
    }
    coarse.vertices[number] += vertex;
    counts[number] += 1;
    cell_of.push_back(number);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) coarse.vertices[i] /= counts[i];
  for (const auto& [a, b, c] : mesh.triangles) coarse.triangles.push_back({cell_of[a], cell_of[b], cell_of[c]});
  tidy(coarse.triangles);
  return coarse;
}

}  // namespace

PieceMesh pieceMesh(const Model& model, std::span<const std::uint32_t> piece) {
  PieceMesh mesh;
  for (const std::uint32_t triangle : piece) {
    for (const std::uint32_t corner : model.triangles[triangle]) mesh.vertices.push_back(model.positions[corner]);
  }
  mesh.vertices = sortedPlaces(std::move(mesh.vertices));
  const auto number = [&](const Vec3& place) {
    const auto found = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), place, precedesPlace);
    return static_cast<std::uint32_t>(found - mesh.vertices.begin());
  };
  for (const std::uint32_t triangle : piece) {
    const auto& [a, b, c] = model.triangles[triangle];
    mesh.triangles.push_back({number(model.positions[a]), number(model.positions[b]), number(model.positions[c])});
  }
  tidy(mesh.triangles);
  mesh.is_turned = sixfoldVolume(mesh) < 0;
  if (mesh.is_turned) {
    for (Corners& corners : mesh.triangles) std::swap(corners[1], corners[2]);
    std::sort(mesh.triangles.begin(), mesh.triangles.end());
  }
  return mesh;
}

Box boundsOf(const PieceMesh& mesh) {
  Box bounds;
  for (const Vec3& vertex : mesh.vertices) bounds.extend(vertex);
  return bounds;
}

double sizeOf(const PieceMesh& mesh) { return boundsOf(mesh).size().norm() / 2; }

PieceMesh coarseMesh(const PieceMesh& mesh, std::size_t most_triangles) {
  PieceMesh coarse = mesh;
  const Box bounds = boundsOf(mesh);
  double cells = kFinestCells;
  while (coarse.triangles.size() > most_triangles) {
    coarse = onGrid(mesh, bounds.min, bounds.size().maxCoeff() / cells);
    cells *= kCoarser;
  }
  return coarse;
}

}  // namespace hl
