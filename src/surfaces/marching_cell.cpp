#include "surfaces/marching_cell.h"

#include <utility>
#include <vector>

namespace hl {

namespace {

constexpr unsigned kFaces = 6, kMasks = 256;

/// Face 2 a + s is across axis a, on side s. Its corners, and its edges each from one corner to the next, run
/// counterclockwise seen from outside.
struct CellFace {
  std::array<std::uint8_t, 4> corners{}, edges{};
};

constexpr unsigned edgeBetween(unsigned a, unsigned b) {
  for (unsigned edge = 0; edge < kCellEdges; ++edge) {
    const unsigned begin = beginOfEdge(edge), end = endOfEdge(edge);
    if ((begin == a && end == b) || (begin == b && end == a)) return edge;
  }
  return kCellEdges;
}

constexpr CellFace faceOf(unsigned number) {
  const unsigned axis = number / 2, side = number % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto base = side << axis;
  std::array<unsigned, 4> around{base, base | 1U << u, base | 1U << u | 1U << v, base | 1U << v};
  if (side == 0) std::swap(around[1], around[3]);
  CellFace face;
  for (unsigned i = 0; i < 4; ++i) {
    face.corners[i] = static_cast<std::uint8_t>(around[i]);
    face.edges[i] = static_cast<std::uint8_t>(edgeBetween(around[i], around[(i + 1) % 4]));
  }
  return face;
}

constexpr std::array<CellFace, kFaces> kCellFaces{faceOf(0), faceOf(1), faceOf(2), faceOf(3), faceOf(4), faceOf(5)};

// Whether the corners of a face lie crosswise inside and outside. Bit c of `inside`: corner c is.
constexpr bool isCrossed(const CellFace& face, unsigned inside) {
  const auto in = [&](unsigned i) { return (inside >> face.corners[i] & 1U) != 0; };
  return in(0) == in(2) && in(1) == in(3) && in(0) != in(1);
}

constexpr bool shareFace(unsigned edge, unsigned other) {
  for (const CellFace& face : kCellFaces) {
    bool has = false, has_other = false;
    for (const std::uint8_t one : face.edges) {
      has |= one == edge;
      has_other |= one == other;
    }
    if (has && has_other) return true;
  }
  return false;
}

/// Crossed edges in the order in which the border of a polygon visits them.
struct CellLoop {
  std::array<std::uint8_t, kCellEdges> edges{};
  unsigned count = 0;
};

// The polygons' sides in a face: after[edge] is the edge that follows. Bit f of `joined`: in face f, which is crossed,
// what is inside is one piece. Seen from outside the cell, a side has what is inside to its right.
constexpr std::array<std::uint8_t, kCellEdges> sidesOf(unsigned inside, unsigned joined) {
  std::array<std::uint8_t, kCellEdges> after{};
  for (unsigned f = 0; f < kFaces; ++f) {
    const CellFace& face = kCellFaces[f];
    const auto in = [&](unsigned i) { return (inside >> face.corners[i % 4] & 1U) != 0; };
    const bool around_outside = isCrossed(face, inside) && (joined >> f & 1U) != 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (in(i) || !in(i + 1)) continue;  // edge i leads inside
      unsigned leaves = i;
      if (around_outside) {
        leaves = (i + 3) % 4;
      } else {
        do leaves = (leaves + 1) % 4;
        while (!in(leaves) || in(leaves + 1));
      }
      after[face.edges[i]] = face.edges[leaves];
    }
  }
  return after;
}

// Cuts off corners whose diagonal lies in no face, until a triangle is left. False: there is no such way.
constexpr bool cutUp(CellLoop loop, CellTriangles& out) {
  if (loop.count == 3) {
    out.edges[out.count++] = {loop.edges[0], loop.edges[1], loop.edges[2]};
    return true;
  }
  for (unsigned i = 0; i < loop.count; ++i) {
    const std::uint8_t before = loop.edges[i], corner = loop.edges[(i + 1) % loop.count],
                       behind = loop.edges[(i + 2) % loop.count];
    if (shareFace(before, behind)) continue;
    CellLoop rest;
    for (unsigned j = 0; j < loop.count; ++j) {
      if (j != (i + 1) % loop.count) rest.edges[rest.count++] = loop.edges[j];
    }
    const std::uint8_t count = out.count;
    out.edges[out.count++] = {before, corner, behind};
    if (cutUp(rest, out)) return true;
    out.count = count;
  }
  return false;
}

constexpr void addFan(const CellLoop& loop, CellTriangles& out) {
  for (unsigned i = 0; i < loop.count; ++i)
    out.edges[out.count++] = {loop.edges[i], loop.edges[(i + 1) % loop.count], kMiddle};
}

constexpr CellTriangles trianglesOf(unsigned inside, unsigned joined) {
  const std::array<std::uint8_t, kCellEdges> after = sidesOf(inside, joined);
  CellTriangles out;
  std::array<bool, kCellEdges> done{};
  for (unsigned edge = 0; edge < kCellEdges; ++edge) {
    const bool crossed = ((inside >> beginOfEdge(edge) ^ inside >> endOfEdge(edge)) & 1U) != 0;
    if (!crossed || done[edge]) continue;
    CellLoop loop;
    for (unsigned at = edge; !done[at]; at = after[at]) {
      done[at] = true;
      loop.edges[loop.count++] = static_cast<std::uint8_t>(at);
    }
    if (!cutUp(loop, out)) addFan(loop, out);
  }
  return out;
}

constexpr unsigned crossedFaces(unsigned inside) {
  unsigned faces = 0;
  for (unsigned f = 0; f < kFaces; ++f) faces |= isCrossed(kCellFaces[f], inside) ? 1U << f : 0U;
  return faces;
}

/// All cells: those of `inside` begin at first[inside], one for each choice of joined faces among those that are
/// crossed, in the order of the numbers that their bits form.
struct CellTable {
  std::array<std::uint16_t, kMasks> first{};
  std::array<std::uint8_t, kMasks> crossed{};
  std::vector<CellTriangles> cells;

  CellTable() {
    for (unsigned inside = 0; inside < kMasks; ++inside) {
      crossed[inside] = static_cast<std::uint8_t>(crossedFaces(inside));
      first[inside] = static_cast<std::uint16_t>(cells.size());
      unsigned joined = 0;
      do {
        cells.push_back(trianglesOf(inside, joined));
        joined = (joined - crossed[inside]) & crossed[inside];  // the next subset
      } while (joined != 0);
    }
  }
};

const CellTable kCells;

// Of the values of the two pairs of opposite corners the saddle is inside where the product of those inside is larger.
bool isJoined(const CellFace& face, const std::array<double, kCellCorners>& value) {
  const double a = value[face.corners[0]] * value[face.corners[2]];
  const double b = value[face.corners[1]] * value[face.corners[3]];
  return value[face.corners[0]] >= 0 ? a >= b : b >= a;
}

}  // namespace

const CellTriangles& trianglesOfCell(const std::array<double, kCellCorners>& value) {
  unsigned inside = 0;
  for (unsigned c = 0; c < kCellCorners; ++c) inside |= value[c] >= 0 ? 1U << c : 0U;
  std::size_t place = kCells.first[inside];
  std::size_t weight = 1;
  for (unsigned f = 0; f < kFaces; ++f) {
    if ((kCells.crossed[inside] >> f & 1U) == 0) continue;
    if (isJoined(kCellFaces[f], value)) place += weight;
    weight *= 2;
  }
  return kCells.cells[place];
}

}  // namespace hl
