// The triangles of a shape as every library takes them: corners and indices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/shape.h"

namespace hl::bench {

/// Valid while the shape lives. Metres, object frame.
struct Mesh {
  std::span<const Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< only those that HL takes: none degenerate
};

Mesh trianglesOf(const Shape& shape);

/// m, over the edges of all triangles, each triangle by itself; 0 when there is none.
double meanEdge_m(const Mesh& mesh);

}  // namespace hl::bench
