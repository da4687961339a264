// Stretched shapes: the copies of shapes that a client's scene scales or shears. They are kept from frame to frame
// while they are used, as a copy has a hierarchy of its own. Lengths as in the shape.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "base/memory_budget.h"
#include "base/vec.h"
#include "scene/scene_limits.h"
#include "scene/shape.h"

namespace hl {

/// By the geometry number of a shape, and the stretch applied to it: the upper half of a symmetric matrix.
using StretchedShapes = std::map<std::tuple<std::uint64_t, std::array<double, 6>>, std::shared_ptr<const Shape>>;

/// The copies that one frame uses. One thread; of() may take long, as it makes shapes.
class StretchedCopies {
 public:
  /// `before`: those of the last frame; it must outlive this. Copies are counted in `memory`.
  StretchedCopies(const StretchedShapes& before, const SceneLimits& limits, MemoryBudget memory)
      : before_(before), memory_(std::move(memory)), sizes_(limits) {}

  /// The shape itself if `stretch`, which is symmetric, is the identity. Throws hl::Error if a limit is exceeded or
  /// memory is short.
  std::shared_ptr<const Shape> of(const std::shared_ptr<const Shape>& shape, const Mat3& stretch);
  StretchedShapes take() { return std::move(used_); }

 private:
  const StretchedShapes& before_;
  const MemoryBudget memory_;
  ModelSizes sizes_;  // a small matrix makes a copy of a large shape
  StretchedShapes used_;
};

}  // namespace hl
