#include "client/geometry.h"

#include <limits>
#include <utility>

namespace hl::client {

namespace {

using Index = std::uint32_t;

// From so many numbers on, moving the vertices' memory is cheaper than copying them and keeping it for the next
// hlBegin.
constexpr std::size_t kMoveFrom = 4096;

bool takesMemoryOf(const Numbers& whole, const Numbers& part) { return whole.empty() && part.size() >= kMoveFrom; }

void makeRoom(Numbers& whole, const Numbers& part) {
  if (!takesMemoryOf(whole, part)) whole.makeRoom(part.size());
}

// There must be room.
void append(Numbers& whole, Numbers& part) {
  if (takesMemoryOf(whole, part)) {
    whole = std::move(part);
    return;
  }
  whole.append(part);
  part.clear();
}

// Writes the indices of whole primitives of a mode, whose vertices begin at index `base`; `count` of them where they
// are drawn one after the other.
class Assembler {
 public:
  Assembler(Geometry& geometry, Index base, Index count, DrawOrder order)
      : geometry_(geometry),
        base_(base),
        order_(order),
        count_(order.empty() ? count : static_cast<Index>(order.size())) {}

  void assemble(HLenum mode) {
    switch (mode) {
      case HL_POINTS:
        return points();
      case HL_LINES:
        return segments(2);
      case HL_LINE_STRIP:
        return segments(1);
      case HL_LINE_LOOP:
        return loop();
      case HL_TRIANGLES:
        return triangles();
      case HL_TRIANGLE_STRIP:
        return strip();
      case HL_TRIANGLE_FAN:
      case HL_POLYGON:
        return fan();
      case HL_QUADS:
        return quads(4);
      case HL_QUAD_STRIP:
        return quads(2);
      default:
        return;
    }
  }

 private:
  // Of the i-th that is drawn.
  Index at(Index i) const { return base_ + (order_.empty() ? i : order_[i]); }
  void triangle(Index a, Index b, Index c) {
    geometry_.triangles.insert(geometry_.triangles.end(), {at(a), at(b), at(c)});
  }
  void segment(Index a, Index b) { geometry_.segments.insert(geometry_.segments.end(), {at(a), at(b)}); }

  void points() {
    for (Index i = 0; i < count_; ++i) geometry_.points.push_back(at(i));
  }
  void segments(Index step) {
    for (Index i = 0; i + 1 < count_; i += step) segment(i, i + 1);
  }
  // Two vertices make one segment: the way back is the same line.
  void loop() {
    segments(1);
    if (count_ > 2) segment(count_ - 1, 0);
  }
  void triangles() {
    for (Index i = 0; i + 2 < count_; i += 3) triangle(i, i + 1, i + 2);
  }
  // Every other triangle is turned round, so that all face the same way.
  void strip() {
    for (Index i = 0; i + 2 < count_; ++i) i % 2 == 0 ? triangle(i, i + 1, i + 2) : triangle(i + 1, i, i + 2);
  }
  void fan() {
    for (Index i = 1; i + 1 < count_; ++i) triangle(0, i, i + 1);
  }
  // In a strip (step 2) the quad after vertex i goes i, i + 1, i + 3, i + 2; alone (step 4) i, i + 1, i + 2, i + 3.
  void quads(Index step) {
    const Index third = step == 2 ? 3 : 2, fourth = step == 2 ? 2 : 3;
    for (Index i = 0; i + 3 < count_; i += step) {
      triangle(i, i + 1, i + third);
      triangle(i, i + third, i + fourth);
    }
  }

  Geometry& geometry_;
  const Index base_;
  const DrawOrder order_;
  const Index count_;  // of vertices drawn
};

}  // namespace

void Vertices::clear() {
  positions.clear();
  normals.clear();
  texcoords.clear();
}

void Vertices::shorten(std::size_t count) {
  positions.shorten(3 * count);
  normals.shorten(3 * count);
  texcoords.shorten(2 * count);
}

bool Geometry::takes(const Vertices& added) const {
  return !heights && !volume && !cloud && !implicit && vertices.normals.empty() == added.normals.empty() &&
         vertices.texcoords.empty() == added.texcoords.empty() &&
         vertices.size() + added.size() <= std::numeric_limits<Index>::max();
}

std::size_t Geometry::bytes() const {
  constexpr std::size_t kIndexBytes = 5, kListBytes = 12;  // the longest varint of 32 bits; tag and length of a list
  const std::size_t numbers = vertices.positions.size() + vertices.normals.size() + vertices.texcoords.size();
  constexpr std::size_t kHeightsHead = 64, kBytesOfColour = 2;  // a number from 128 on takes two
  if (heights) return heights->samples(0).size() + kHeightsHead;
  std::size_t of_patches = 0;
  for (const proto::Patch& patch : patches) of_patches += patch.ByteSizeLong() + kListBytes;
  if (of_patches > 0) return of_patches;
  if (cloud)
    return static_cast<std::size_t>(cloud->positions_size()) * sizeof(double) +
           static_cast<std::size_t>(cloud->normals_size()) * sizeof(float) +
           static_cast<std::size_t>(cloud->colours_size()) * kBytesOfColour + kHeightsHead;
  return numbers * sizeof(double) + (triangles.size() + segments.size() + points.size()) * kIndexBytes + 6 * kListBytes;
}

std::size_t wholeVertices(HLenum mode, std::size_t count) {
  const auto at_least = [count](std::size_t least) { return count < least ? 0 : count; };
  switch (mode) {
    case HL_LINES:
      return count - count % 2;
    case HL_LINE_STRIP:
    case HL_LINE_LOOP:
      return at_least(2);
    case HL_TRIANGLES:
      return count - count % 3;
    case HL_TRIANGLE_STRIP:
    case HL_TRIANGLE_FAN:
    case HL_POLYGON:
      return at_least(3);
    case HL_QUADS:
      return count - count % 4;
    case HL_QUAD_STRIP:
      return at_least(4) - at_least(4) % 2;
    default:
      return count;
  }
}

void appendPrimitives(Geometry& geometry, HLenum mode, Vertices& vertices, DrawOrder order) {
  const auto base = static_cast<Index>(geometry.vertices.size());
  const auto count = static_cast<Index>(vertices.size());
  const std::size_t triangles = geometry.triangles.size(), segments = geometry.segments.size(),
                    points = geometry.points.size();
  try {
    Assembler(geometry, base, count, order).assemble(mode);
    makeRoom(geometry.vertices.positions, vertices.positions);
    makeRoom(geometry.vertices.normals, vertices.normals);
    makeRoom(geometry.vertices.texcoords, vertices.texcoords);
  } catch (...) {
    geometry.triangles.resize(triangles);
    geometry.segments.resize(segments);
    geometry.points.resize(points);
    throw;
  }
  append(geometry.vertices.positions, vertices.positions);
  append(geometry.vertices.normals, vertices.normals);
  append(geometry.vertices.texcoords, vertices.texcoords);
}

}  // namespace hl::client
