// Geometry: vertices and lists of indices into them, as the message Primitives holds them, but cheap to append to.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
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
  std::vector<std::uint32_t> triangles;               ///< three indices each
  std::vector<std::uint32_t> segments;                ///< two each
  std::vector<std::uint32_t> points;                  ///< one each
  std::optional<proto::Heights> heights{};            ///< in place of all others; samples in one piece
  std::array<double, 2> repeat{1, 1};                 ///< of the heights: factors of their texture coordinates
  std::shared_ptr<const proto::Volume> volume{};      ///< in place of all others; one for all its surfaces
  double iso = 0;                                     ///< of the volume
  bool below = false;                                 ///< of the volume: where its matter is
  std::vector<proto::Patch> patches{};                ///< in place of all others
  double patch_error = 0;                             ///< of the patches; 0: the server's choice
  std::shared_ptr<proto::Cloud> cloud{};              ///< in place of all others
  std::shared_ptr<const proto::Implicit> implicit{};  ///< in place of all others
  /// Whether `added` could be appended: all vertices have normals or none has, the same for texture coordinates, and
  /// the indices fit.
  bool takes(const Vertices& added) const;
  /// An upper bound of the bytes of its message.
  std::size_t bytes() const;
};

/// In which order vertices are drawn, by their numbers; empty: one after the other, each once.
using DrawOrder = std::span<const std::uint32_t>;

/// Appends the primitives of `mode` that `vertices` make in that order, with GL's order in each, and leaves `vertices`
/// empty. They must be whole primitives, and `geometry` must take them.
void appendPrimitives(Geometry& geometry, HLenum mode, Vertices& vertices, DrawOrder order);

/// How many of `count` vertices make whole primitives of `mode`.
std::size_t wholeVertices(HLenum mode, std::size_t count);

}  // namespace hl::client
