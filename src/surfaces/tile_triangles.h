// TileTriangles: which triangles of a tile of a depth image a ball on a straight way may touch. Compiled once for each
// instruction set; all give the same bits.
//
// A triangle is left out where a plane separates it from the ball all the way: across the direction to its middle,
// which shows triangles that are small against their distance, or across its normal, which shows large ones. All
// is in float, relative to the middle of the way and in units of the radius; the caller makes it larger by the
// rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hl {

/// The ball, and the places of the pixels of a tile: depth (column + row) - middle.
struct TileBall {
  static constexpr std::size_t kCells = 8, kPixels = kCells + 1;  // along a side
  using Axis = std::array<float, kPixels>;

  std::array<Axis, 3> column, row;    ///< of each pixel, for a unit of depth
  std::array<float, 3> middle, half;  ///< of the way; half of it
  float join;                         ///< as DepthCamera has it
};

/// Triangles by rows of cells: first triangle 0 of each cell, then triangle 1 (height_cell.h).
struct TileTouches {
  static constexpr std::size_t kTriangles = 2 * TileBall::kCells;

  std::array<std::uint16_t, TileBall::kCells> bits;                      ///< of a row: those that may be touched
  std::array<std::array<float, kTriangles>, TileBall::kCells> earliest;  ///< from -1, the start, to 1, the end
};

/// `earliest` is set of those that may be touched: where the ball is not beyond it, it is not before that moment.
/// `first`: the depth of the tile's first pixel, with `stride` from row to row; kPixels are read in each of `rows` + 1
/// rows. RT-safe.
void touchedTriangles(const TileBall& ball, const float* first, std::size_t stride, std::size_t rows,
                      TileTouches& touches);

}  // namespace hl
