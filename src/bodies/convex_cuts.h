// Convex cuts: a surface that is not convex, cut by planes into pieces that nearly are.
//
// While a piece is farther from its hull than allowed (piece_measure.h), the worst one is cut in two. Planes that may
// cut it are those through the point from which the way out of the hull is longest, along the surface there and across
// it, and some across the axes. That one is taken which leaves the shortest ways out. At last neighbours are joined
// whose common hull is near enough. What is deep inside of a solid may be in no hull: nothing gets there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bodies/piece_measure.h"

namespace hl {

struct CutRules {
  bool is_shell = false;
  double allowed_m = 0;  ///< > 0
  std::size_t most = 1;  ///< > 0
  /// Cuts no more after so many looks at a triangle (HullExcess::looks), of 2 to 10 ns each, for each triangle of the
  /// surface: solids take a third of it. That is up to 3 ms for each, 9 s for the most that are cut.
  std::uint64_t looks_of_each = 300'000;
};

struct NearPiece {
  CutPiece piece;
  double error_m = 0;  ///< of its hull (piece_measure.h)
};

/// Pieces that together are the surface of `whole`; at most `most` of them, so they may be farther from their hulls
/// than allowed. The time grows with triangles times pieces: about a second for 1000 triangles and 60 pieces.
/// Neighbours that are not joined when it is up are more pieces than need be. Setup only.
std::vector<NearPiece> cutPieces(const CutPiece& whole, const CutRules& rules);

}  // namespace hl
