// NurbsPatch: a Bezier or NURBS surface without trims, as its control points say it; and the Bezier pieces that it is
// made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace hl {

/// A control point: `at` counts `weight` times.
struct ControlPoint {
  Vec3 at = Vec3::Zero();
  double weight = 1;
  /// x, y, z and 1, each times the weight.
  Eigen::Vector4d homogeneous() const { return {weight * at.x(), weight * at.y(), weight * at.z(), weight}; }
  bool operator==(const ControlPoint&) const = default;
};

inline constexpr std::uint32_t kMaxPatchOrder = 8;
/// Along one side.
inline constexpr std::uint32_t kMaxControlPoints = 4096;
/// Weights and steps between knots may differ by this factor.
inline constexpr double kMaxWeightRatio = 1e6;

/// Points row by row, u the faster. Metres, object frame.
struct NurbsPatch {
  std::uint32_t order_u = 4, order_v = 4;  ///< degree + 1
  std::vector<ControlPoint> points;
  std::vector<double> knots_u, knots_v;  ///< control points along the side + order; empty: one Bezier piece
};

/// Throws hl::Error for orders, numbers of points, knots or weights that make no surface.
void checkPatch(const NurbsPatch& patch);

/// At most so many Bezier pieces are in a patch that checkPatch() takes.
std::uint64_t mostPiecesOf(const NurbsPatch& patch);

/// A net of Bezier pieces: neighbours share the control points of their common side. Knots have become pieces by knot
/// insertion, which changes no point of the surface.
struct BezierNet {
  std::uint32_t degree_u, degree_v;
  std::vector<double> breaks_u, breaks_v;  ///< where pieces begin and end, 0..1
  std::vector<ControlPoint> points;        ///< row by row

  std::size_t piecesU() const { return breaks_u.size() - 1; }
  std::size_t piecesV() const { return breaks_v.size() - 1; }
  std::size_t columns() const { return piecesU() * degree_u + 1; }
};

/// Of a patch that checkPatch() takes.
BezierNet bezierNetOf(const NurbsPatch& patch);

}  // namespace hl
