// Primitives: the primitives of one shape, each computed from the vertices and index lists of the mesh when it is read.
// Stored, they would take 104 bytes each; the mesh itself takes 12 to 24 bytes per triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/primitive.h"

namespace hl {

/// Views of the lists of a mesh. Indices refer to `positions`; metres.
struct MeshView {
  std::span<const Vec3> positions;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  std::span<const std::array<std::uint32_t, 2>> segments;
  std::span<const std::uint32_t> points;
  std::size_t elements() const { return triangles.size() + segments.size() + points.size(); }
};

/// A view: the mesh must outlive it and must not change. Reading is RT-safe, on any thread.
class Primitives {
 public:
  /// Number of elements that are not valid primitives, by kind: degenerate, out of reach, or with an index out of
  /// range.
  struct Refused {
    std::size_t triangles = 0, segments = 0, points = 0;
    std::size_t sum() const { return triangles + segments + points; }
  };

  Primitives() = default;
  /// Triangles first, then segments, then points; refused elements are left out. O(n) on all threads of oneTBB; the
  /// result does not depend on their number. Setup only.
  explicit Primitives(const MeshView& mesh);
  /// The listed elements only, degenerate or not: see shrunkenOf(). `elements`: increasing numbers among all elements
  /// (triangles, segments, points). Their vertices must be within reach.
  Primitives(const MeshView& mesh, std::vector<std::uint32_t> elements);
  /// A list of primitives, in any order.
  Primitives(std::span<const Primitive> ready) : ready_(ready), size_(ready.size()) {}                // NOLINT: a view
  Primitives(const std::vector<Primitive>& ready) : Primitives(std::span<const Primitive>(ready)) {}  // NOLINT: a view

  const Refused& refused() const { return refused_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Whether the same elements have the same numbers in both, for two meshes with the same lists.
  bool numberedAs(const Primitives& other) const { return size_ == other.size_ && kept_ == other.kept_; }
  /// Number of the element of primitive i, among all elements of the mesh.
  std::uint32_t elementNumber(std::size_t i) const { return kept_.empty() ? static_cast<std::uint32_t>(i) : kept_[i]; }
  /// Bounds of all vertices used. O(1) for a mesh, O(n) for a list of primitives.
  Box bounds() const;
  /// Memory, bytes, without the mesh.
  std::size_t bytes() const { return kept_.capacity() * sizeof(std::uint32_t); }

  Primitive operator[](std::size_t i) const;
  PrimitiveKind kind(std::size_t i) const;
  PrimitiveKind elementKind(std::size_t i) const;  ///< of a mesh: the kind before it became degenerate
  /// As Primitive::source.
  std::uint32_t source(std::size_t i) const;
  /// The vertices in the given order; a segment's last vertex is repeated once, a point's twice.
  std::array<Vec3, 3> corners(std::size_t i) const;

  class Iterator {
   public:
    Iterator(const Primitives& of, std::size_t at) : of_(of), at_(at) {}
    Primitive operator*() const { return of_[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const Primitives& of_;
    std::size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

 private:
  /// An element of the mesh: its list, and its index in the list.
  struct Element {
    PrimitiveKind kind;
    std::uint32_t source;
  };
  Element element(std::size_t i) const;
  /// A range of elements checked by one thread.
  struct Run {
    Box bounds;                          // of the valid elements
    std::vector<std::uint32_t> refused;  // numbers of the invalid elements among all elements
  };
  Run look(std::size_t begin, std::size_t end) const;
  void leaveOut(const std::vector<Run>& runs);
  bool valid(const Element& element) const;
  std::array<Vec3, 3> corners(const Element& element) const;

  MeshView mesh_;
  std::vector<std::uint32_t> kept_;  // numbers among all elements of the mesh; empty when none was refused
  std::span<const Primitive> ready_;
  std::size_t size_ = 0;
  bool shrunken_ = false;  // some elements may be degenerate
  Refused refused_;
  Box bounds_;  // bounds, if it is a mesh
};

// Inline for loops over millions of primitives.

inline Primitives::Element Primitives::element(std::size_t i) const {
  std::size_t number = kept_.empty() ? i : kept_[i];
  if (number < mesh_.triangles.size()) return {PrimitiveKind::kTriangle, static_cast<std::uint32_t>(number)};
  number -= mesh_.triangles.size();
  if (number < mesh_.segments.size()) return {PrimitiveKind::kSegment, static_cast<std::uint32_t>(number)};
  return {PrimitiveKind::kPoint, static_cast<std::uint32_t>(number - mesh_.segments.size())};
}

inline std::array<Vec3, 3> Primitives::corners(const Element& element) const {
  const auto& p = mesh_.positions;
  switch (element.kind) {
    case PrimitiveKind::kTriangle: {
      const auto& t = mesh_.triangles[element.source];
      return {p[t[0]], p[t[1]], p[t[2]]};
    }
    case PrimitiveKind::kSegment: {
      const auto& s = mesh_.segments[element.source];
      return {p[s[0]], p[s[1]], p[s[1]]};
    }
    case PrimitiveKind::kPoint:
      break;
  }
  const Vec3& point = p[mesh_.points[element.source]];
  return {point, point, point};
}

inline std::array<Vec3, 3> Primitives::corners(std::size_t i) const {
  return ready_.empty() ? corners(element(i)) : ready_[i].vertex;
}

}  // namespace hl
