#include "scene/model.h"

#include <cassert>

namespace hl {

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
  for (Vec3& position : model.positions) position = placement.linear * position + placement.offset;
  for (Vec3& normal : model.normals) {
    const Vec3 turned = (for_normals * normal).normalized();
    normal = turned.allFinite() ? turned : Vec3(Vec3::Zero());
  }
}

void scaleModel(Model& model, double factor) {
  assert(factor > 0);
  for (Vec3& position : model.positions) position *= factor;
}

double fitModel(Model& model, double side) {
  const Box box = model.bounds();
  if (box.empty() || !(box.size().maxCoeff() > 0)) return 1;
  const double factor = side / box.size().maxCoeff();
  const Vec3 centre = box.centre();
  for (Vec3& position : model.positions) position = factor * (position - centre);
  return factor;
}

}  // namespace hl
