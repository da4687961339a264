#include "scene/model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>

namespace hl {

void Reading::add(const Reading& other) {
  joined_vertices += other.joined_vertices;
  single_precision = single_precision || other.single_precision;
  patch_error_m = std::max(patch_error_m, other.patch_error_m);
  if (!other.cad) return;
  if (!cad) {
    cad = other.cad;
    return;
  }
  cad->deflection_m = std::max(cad->deflection_m, other.cad->deflection_m);
  cad->angle_rad = std::max(cad->angle_rad, other.cad->angle_rad);
  cad->error_m = std::max(cad->error_m, other.cad->error_m);
  cad->tolerance_m = std::max(cad->tolerance_m, other.cad->tolerance_m);
  cad->solids += other.cad->solids;
  cad->faces += other.cad->faces;
}

void Reading::scale(double factor) {
  patch_error_m *= factor;
  if (!cad) return;
  for (double* length : {&cad->deflection_m, &cad->error_m, &cad->tolerance_m}) *length *= factor;
}

namespace {

// Calls visit(index) for each that an element has, and that there is, as often as it has it.
template <typename Visit>
void forEachUsed(const Model& model, const Visit& visit) {
  const auto look = [&](std::uint32_t index) {
    if (index < model.positions.size() && model.positions[index].allFinite()) visit(index);
  };
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) look(index);
  }
  for (const auto& segment : model.segments) {
    for (const std::uint32_t index : segment) look(index);
  }
  for (const std::uint32_t index : model.points) look(index);
}

}  // namespace

Box Model::bounds() const {
  Box box;
  forEachUsed(*this, [&](std::uint32_t index) { box.extend(positions[index]); });
  return box;
}

std::vector<Vec3> Model::usedPositions() const {
  std::vector<bool> is_used(positions.size());
  forEachUsed(*this, [&](std::uint32_t index) { is_used[index] = true; });
  std::vector<Vec3> used;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (is_used[i]) used.push_back(positions[i]);
  }
  return used;
}

void placeModel(Model& model, const Placement& placement) {
  const Mat3 for_normals = placement.linear.inverse().transpose();
  model.reading.scale(placement.linear.operatorNorm());
  for (Vec3& position : model.positions) position = placement.linear * position + placement.offset;
  for (Vec3& normal : model.normals) {
    const Vec3 turned = (for_normals * normal).normalized();
    normal = turned.allFinite() ? turned : Vec3(Vec3::Zero());
  }
}

void scaleModel(Model& model, double factor) {
  assert(factor > 0);
  model.reading.scale(factor);
  for (Vec3& position : model.positions) position *= factor;
}

double fitModel(Model& model, double side) {
  const Box box = model.bounds();
  if (box.empty() || !(box.size().maxCoeff() > 0)) return 1;
  const double factor = side / box.size().maxCoeff();
  const Vec3 centre = box.centre();
  model.reading.scale(factor);
  for (Vec3& position : model.positions) position = factor * (position - centre);
  return factor;
}

}  // namespace hl
