// Geometry: vertices and lists of indices into them, as the message Primitives holds them, but cheap to append to.
#pragma once

#include <hl/hl_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/numbers.h"

namespace hl::client {

/// The vertices of one hlBegin .. hlEnd, in the order drawn.
struct Vertices {
  Numbers positions;  ///< x y z each
  Numbers normals;    ///< x y z for each vertex, or empty: none has a normal
  Numbers texcoords;  ///< u v for each vertex, or empty
  std::size_t size() const { return positions.size() / 3; }
  void clear();
  void shorten(std::size_t count);  ///< to at most so many
};

struct Geometry {
  Vertices vertices;
  std::vector<std::uint32_t> triangles;  ///< three indices each
  std::vector<std::uint32_t> segments;   ///< two each
  std::vector<std::uint32_t> points;     ///< one each
  /// Whether `added` could be appended: all vertices have normals or none has, the same for texture coordinates, and
  /// the indices fit.
  bool takes(const Vertices& added) const;
  /// An upper bound of the bytes of its message.
  std::size_t bytes() const;
};

/// Appends the primitives of `mode` that `vertices` make, with GL's order of vertices in each, and leaves `vertices`
/// empty. Vertices that do not fill the last primitive are dropped. `geometry` must take them.
void appendPrimitives(Geometry& geometry, HLenum mode, Vertices& vertices);

/// How many of `count` vertices make whole primitives of `mode`.
std::size_t wholeVertices(HLenum mode, std::size_t count);

}  // namespace hl::client
