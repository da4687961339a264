// Sheet clip: the part of a triangle of a sheet that is the surface of the whole.
//
// The functions of the conditions are interpolated linearly over the triangle, so what is left is cut by straight
// lines. A cut on an edge is a function of the edge's two ends alone: triangles that share it agree to the bit.
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"
#include "surfaces/implicit/implicit_function.h"
#include "surfaces/implicit/sheet_sides.h"

namespace hl {

inline constexpr std::size_t kMaxPieces = 32;

/// Triangles with the orientation of the one that was cut.
struct SheetPieces {
  std::size_t count = 0;
  std::size_t looks = 0;  ///< at functions, for each corner of the triangle
  std::array<std::array<Vec3, 3>, kMaxPieces> triangles;
};

/// `sides`: of a box that holds the triangle, of the same slack; what is known of it is not looked at again.
/// `slack`: how much below 0 a condition's value may be; then what two sheets keep overlaps at the edge between them,
/// where otherwise a gap would be. A triangle that falls into more than kMaxPieces stays whole. RT-safe.
void clipToSheet(const ImplicitFunction& function, std::size_t sheet, double slack, const SheetSides& sides,
                 const std::array<Vec3, 3>& triangle, SheetPieces& out);

}  // namespace hl
