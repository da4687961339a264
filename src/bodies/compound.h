// Compound: the shape of a body: the union of convex parts, which do not move against each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "bodies/convex.h"

namespace hl {

/// Immutable. Frame of the body, as Convex.
struct Compound {
  Compound() = default;
  /// Most bodies are one convex shape.
  Compound(Convex part) : parts{std::move(part)}, reach(parts.front().reach) {}
  /// At least one.
  explicit Compound(std::vector<Convex> several) : parts(std::move(several)) { measureReach(); }

  /// Its surface stays where it is when it turns.
  bool isBall() const { return parts.size() == 1 && parts.front().vertices.size() == 1; }

  std::vector<Convex> parts;
  double reach = 0;  ///< m, greatest distance of all of it from the origin

 private:
  void measureReach() {
    for (const Convex& part : parts) {
      for (const Vec3& vertex : part.vertices) reach = std::max(reach, vertex.norm() + part.radius);
    }
  }
};

/// A body has no more: what a step costs is bounded.
inline constexpr std::size_t kMaxParts = 64;

}  // namespace hl
