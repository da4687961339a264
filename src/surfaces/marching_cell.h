// Marching cell: which triangles an iso surface has in one cell of a grid, from the samples at its eight corners.
//
// Marching cubes (W. Lorensen, H. Cline, SIGGRAPH 1987) without ambiguity: where the corners of a face lie crosswise
// inside and outside, the value at the saddle of the face decides (G. Nielson, B. Hamann, Visualization 1991). Both
// cells at a face decide by the same four samples, so their triangles fit together without a gap. No diagonal of a
// polygon lies in a face of the cell, so each edge of a surface belongs to two triangles; a polygon that cannot be cut
// up like this is a fan about the mean of its corners.
//
// Corner c of a cell has the offsets (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + b runs along axis a, from the corner
// whose offsets along the axes (a + 1) % 3 and (a + 2) % 3 are b & 1 and b >> 1.
#pragma once

#include <array>
#include <cstdint>

namespace hl {

inline constexpr unsigned kCellCorners = 8, kCellEdges = 12, kMaxCellTriangles = 12;
/// In place of an edge: the middle of the polygon that is a fan; a cell has one at most.
inline constexpr unsigned kMiddle = kCellEdges;

/// The corner at which an edge begins, and where it ends.
constexpr unsigned beginOfEdge(unsigned edge) {
  const unsigned axis = edge / 4, across = edge % 4;
  return (across & 1U) << (axis + 1) % 3 | (across >> 1U) << (axis + 2) % 3;
}
constexpr unsigned endOfEdge(unsigned edge) { return beginOfEdge(edge) | 1U << edge / 4; }

/// Each triangle by the edges on which its corners lie, counterclockwise seen from outside, if the axes are
/// right-handed. Of a fan, the last corner of each triangle is kMiddle.
struct CellTriangles {
  std::uint8_t count = 0;
  std::array<std::array<std::uint8_t, 3>, kMaxCellTriangles> edges{};
};

/// `value`: at the corners, relative to the iso value: inside is >= 0. RT-safe.
const CellTriangles& trianglesOfCell(const std::array<double, kCellCorners>& value);

}  // namespace hl
