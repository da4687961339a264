// CutPiece: a piece of a surface, with what is asked of its convex hull again and again: corners, and those that reach
// farthest.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "bodies/convex_hull.h"
#include "bodies/plane_cuts.h"
#include "geometry/box.h"
#include "geometry/primitive.h"

namespace hl {

class CutPiece {
 public:
  static constexpr std::size_t kDirections = 48;
  using Extremes = std::array<Vec3, kDirections>;

  explicit CutPiece(CutSurface surface);
  /// Both together.
  CutPiece(const CutPiece& a, const CutPiece& b);

  bool empty() const { return surface_.empty(); }
  const CutSurface& surface() const { return surface_; }
  const std::vector<Primitive>& primitives() const { return primitives_; }  ///< triangles that have an area
  const std::vector<Vec3>& corners() const { return corners_; }             ///< each once, ascending (places.h)
  /// Those that reach farthest in directions all over the ball; of several, the first in the order of places. Of an
  /// empty piece none is.
  const Extremes& extremes() const { return extremes_; }
  const Box& bounds() const { return bounds_; }
  const Slab& slab() const { return slab_; }  ///< the thinnest about it
  /// The corners of a piece at least so thick (m): what is flatter grows inward, or, if it faces both ways, to both
  /// sides.
  std::vector<Vec3> thickCorners(double thickness_m) const;

 private:
  CutSurface surface_;
  std::vector<Primitive> primitives_;
  std::vector<Vec3> corners_;
  Extremes extremes_;
  Box bounds_;
  Slab slab_;
};

/// Each once, in the order of the directions.
std::vector<Vec3> distinct(const CutPiece::Extremes& extremes);
/// Of both together.
CutPiece::Extremes joined(const CutPiece::Extremes& a, const CutPiece::Extremes& b);

}  // namespace hl
