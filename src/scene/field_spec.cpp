#include "scene/field_spec.h"

#include <algorithm>

namespace hl {

double pullOf_N(const FieldSpec& field, double distance_m) {
  if (!(distance_m < field.reach_m)) return 0;
  if (field.kind == FieldKind::kSpring) return std::min(field.stiffness_N_m * distance_m, field.force_N);
  if (field.kind != FieldKind::kMagnet) return 0;
  constexpr double kUnit = 6.75;  // of u (1 - u)^2, whose largest value is 4/27
  const double u = distance_m / field.reach_m;
  return field.force_N * kUnit * u * (1 - u) * (1 - u);
}

double pushOf_N(const FieldSpec& field, double distance_m) {
  if (field.kind != FieldKind::kConstant || !(distance_m < field.reach_m)) return 0;
  const double u = distance_m / field.reach_m;
  return field.force_N * (1 - u * u) * (1 - u * u);
}

FieldList placed(const FieldList& fields, const Placement& placement) {
  FieldList moved = fields;
  for (FieldSpec& field : moved) {
    for (Vec3& point : field.points) point = placement.linear * point + placement.offset;
    if (field.normal) field.normal = (placement.linear.inverse().transpose() * *field.normal).stableNormalized();
    if (field.kind == FieldKind::kConstant) field.direction = (placement.linear * field.direction).stableNormalized();
  }
  return moved;
}

std::size_t pointsIn(const FieldList& fields) {
  std::size_t points = 0;
  for (const FieldSpec& field : fields) points += field.points.size();
  return points;
}

std::size_t bytesOf(const FieldList& fields) {
  std::size_t bytes = sizeof(FieldList) + fields.capacity() * sizeof(FieldSpec);
  for (const FieldSpec& field : fields) bytes += field.points.capacity() * sizeof(Vec3) + field.name.capacity();
  return bytes;
}

}  // namespace hl
