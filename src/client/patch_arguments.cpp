#include "client/patch_arguments.h"

#include <cstddef>

#include "base/error.h"
#include "client/fault.h"
#include "surfaces/nurbs_patch.h"

namespace hl::client {

namespace {

// Throws unless that many control points can be read.
std::size_t controlPoints(const SurfaceSide& side, HLint least_stride) {
  if (side.order < 2 || side.order > static_cast<HLint>(kMaxPatchOrder))
    throw Fault(HL_INVALID_VALUE, "orders must be 2 to 8: degree + 1");
  if (side.stride < least_stride) throw Fault(HL_INVALID_VALUE, "a stride is shorter than a control point");
  if (side.knot_count == 0) return static_cast<std::size_t>(side.order);
  if (side.knot_count < 2 * side.order || side.knot_count - side.order > static_cast<HLsizei>(kMaxControlPoints))
    throw Fault(HL_INVALID_VALUE, "knots must be at least twice the order, and at most 4096 + order, in number");
  if (side.knots == nullptr) throw Fault(HL_INVALID_VALUE, "the knots are NULL");
  return static_cast<std::size_t>(side.knot_count - side.order);
}

ControlPoint controlPoint(const HLdouble* numbers, bool weighted) {
  const Vec3 at(numbers[0], numbers[1], numbers[2]);
  if (!weighted) return {at};
  return {at / numbers[3], numbers[3]};
}

void putPatch(const NurbsPatch& patch, bool weighted, proto::Patch& out) {
  out.set_order_u(patch.order_u);
  out.set_order_v(patch.order_v);
  for (const ControlPoint& point : patch.points) {
    for (const double number : point.at) out.add_points(number);
    if (weighted) out.add_weights(point.weight);
  }
  out.mutable_knots_u()->Add(patch.knots_u.begin(), patch.knots_u.end());
  out.mutable_knots_v()->Add(patch.knots_v.begin(), patch.knots_v.end());
}

}  // namespace

proto::Patch patchOf(const SurfaceSide& u, const SurfaceSide& v, const HLdouble* points, HLenum type) {
  if (type != HL_MAP2_VERTEX_3 && type != HL_MAP2_VERTEX_4)
    throw Fault(HL_INVALID_ENUM, "control points are HL_MAP2_VERTEX_3 or HL_MAP2_VERTEX_4");
  if (points == nullptr) throw Fault(HL_INVALID_VALUE, "the control points are NULL");
  const bool weighted = type == HL_MAP2_VERTEX_4;
  const std::size_t columns = controlPoints(u, weighted ? 4 : 3), rows = controlPoints(v, weighted ? 4 : 3);
  NurbsPatch patch{static_cast<std::uint32_t>(u.order), static_cast<std::uint32_t>(v.order), {}, {}, {}};
  if (u.knot_count > 0) patch.knots_u.assign(u.knots, u.knots + u.knot_count);
  if (v.knot_count > 0) patch.knots_v.assign(v.knots, v.knots + v.knot_count);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t place = i * static_cast<std::size_t>(u.stride) + j * static_cast<std::size_t>(v.stride);
      patch.points.push_back(controlPoint(points + place, weighted));
    }
  }
  proto::Patch out;
  try {
    checkPatch(patch);
  } catch (const Error& error) {
    throw Fault(HL_INVALID_VALUE, error.what());
  }
  putPatch(patch, weighted, out);
  return out;
}

}  // namespace hl::client
