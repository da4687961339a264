// ImplicitSurface: the surface of an expression, whose triangles are computed from the function when they are asked
// for: no samples are kept, so their number is bound by the stated error alone.
//
// Over a triangle within a ball of radius R, f differs from linear interpolation of its values at the corners by at
// most |f''| R^2 / 2. A cell of side h lies in a ball of R^2 = 3/4 h^2, and on its edges, where the corners of
// triangles lie, linear interpolation is off by at most |f''| h^2 / 8. So |f| <= |f''| h^2 / 2 on a triangle, and the
// surface is within
//   h^2 / 2 max|f''| / min|f'|.
// The maximum is bounded by interval arithmetic (sheet_measure.h); h is chosen by it.
#pragma once

#include <array>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/grid_frame.h"
#include "surfaces/implicit/implicit_spec.h"

namespace hl {

/// A function with its sheets.
struct SheetList;

/// Immutable.
class ImplicitSurface final : public PrimitiveSource {
 public:
  /// Throws hl::Error for an expression that cannot be, has no surface in its bounds, or whose surface cannot be kept
  /// within the error: where it has a point or an edge of its own, or is too large for it. Looks at tens of thousands
  /// of boxes, which takes some 10 ms.
  explicit ImplicitSurface(const ImplicitSpec& spec);

  ElementId count() const override;
  std::uint64_t triangles() const override { return triangles_; }
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// Up the gradient of the smooth function whose surface it is.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  SharedMemory shared() const override;
  /// Certain, but for edges of less than 90 degrees, where it is larger by up to 1.25 / sin(angle), and for corners of
  /// three faces: at right angles by up to 1.42.
  double error_m() const override;
  /// By the sign of the function.
  Site siteOf(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const ImplicitSpec& spec() const;
  /// From the coordinates of the expression to m.
  const GridFrame& frame() const { return frame_; }
  std::size_t sheets() const;
  /// m: the side of the smallest and of the largest cells, where they are placed; of a stretched one the longest.
  std::array<double, 2> steps() const;

 private:
  ImplicitSurface(std::shared_ptr<const SheetList> list, const GridFrame& frame);
  void place();
  DrawnMesh drawnCoarser(double factor) const;

  std::shared_ptr<const SheetList> list_;
  GridFrame frame_;
  Mat3 across_;  // inverse of the frame's axes
  bool mirrored_ = false;
  Box bounds_;
  std::uint64_t triangles_ = 0;
};

}  // namespace hl
