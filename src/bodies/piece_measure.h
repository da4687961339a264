// Piece measure: how far the convex hull of a piece of a surface reaches beyond what it stands for.
//
// Of a solid: from a point of the surface, along its outward normal, the hull is full of air until the way meets the
// surface again or leaves the hull: across a hole, a groove or the inside of a cup. The error is how far the middle of
// such a way, or its end, is from the surface. Where parts of a piece are apart, such ways may miss the air between
// them: the middles of some lines between corners are measured too, if they are not within the solid.
//
// Of a shell, such as a bowl without thickness, and of a flat piece: the line between two of its corners lies in the
// hull, and all that is not on the surface is air. The error is how far its middle is from the surface.
#pragma once

#include <cstdint>
#include <limits>

#include "bodies/cut_piece.h"

namespace hl {

struct HullExcess {
  double error_m = 0;  ///< how far the hull reaches beyond the piece
  double air_m = 0;    ///< the longest way through the hull from the surface along its normal; of a shell, the error
  /// Where that way begins; of a shell, the middle of a line and its direction.
  Vec3 place = Vec3::Zero(), normal = Vec3::UnitX();
  std::uint64_t looks = 0;  ///< triangles and planes that were looked at: what measuring cost
};

class PieceMeasure {
 public:
  /// Points of the surface that are measured are no farther apart than four times `allowed_m` (> 0), or an eighth of a
  /// triangle. Errors below `allowed_m` may be given as the way through the air, which is longer.
  /// `whole`: what all pieces are of; must outlive this.
  PieceMeasure(const CutSurface& whole, bool is_shell, double allowed_m)
      : whole_(whole), is_shell_(is_shell), allowed_m_(allowed_m) {}

  /// Flat pieces are as thick as this, m.
  double thickness() const { return allowed_m_ / 2; }
  HullExcess exactly(const CutPiece& piece) const;
  /// Of both together, by lines alone: no more than exactly() gives. Measures no more once the error is above
  /// `enough_m`. Much faster where they are apart.
  HullExcess atLeast(const CutPiece& a, const CutPiece& b, double enough_m) const;
  /// Without the error of a solid; from some points, and of a hull of those corners that reach farthest: ten times
  /// faster.
  HullExcess roughly(const CutPiece& piece) const;

 private:
  bool isShell(const CutPiece& piece) const { return is_shell_ || piece.slab().thickness < thickness(); }

  const CutSurface& whole_;
  bool is_shell_;
  double allowed_m_;
};

}  // namespace hl
