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

Box Model::bounds() const {
  Box box;
  const auto extend = [&](std::uint32_t index) {
    if (index < positions.size() && positions[index].allFinite()) box.extend(positions[index]);
  };
  for (const auto& triangle : triangles) {
    for (const std::uint32_t index : triangle) extend(index);
  }
  for (const auto& segment : segments) {
    for (const std::uint32_t index : segment) extend(index);
  }
  for (const std::uint32_t index : points) extend(index);
  return box;
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
