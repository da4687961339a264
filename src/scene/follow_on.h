// Following on: the instances of a client's next snapshot, from those of its last one. What was there before moves,
// deforms and yields its way to what it is now. World frame, metres; times in ns of the clock of the loops. Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "scene/placed_shape.h"
#include "scene/snapshot.h"

namespace hl {

struct Followed {
  std::vector<Instance> instances;
  std::int64_t blend_ns = 0;  ///< blend_ns of the next snapshot
  std::size_t jumps = 0;      ///< meshes that change at once because there was no memory for a transition
};

/// The instances of the next snapshot, from those of this client in the last one; both sorted by key. An object that
/// existed moves from its pose at `begin_ns` to its new pose at `end_ns`. A new object is at its pose at once, as are
/// all if end_ns <= begin_ns. A mesh deforms in the same time, or in kAbruptBlend_ns; a transition that has begun is
/// completed first. The memory for this is counted in `memory`; a mesh for which there is no room changes at once. What
/// is no mesh always does, in the snapshot of the given number. A rigid body goes on from where it is while its start
/// is the same; `scene`: bounds of all that it may meet.
Followed followOn(const std::vector<PlacedShape>& placed, std::span<const Instance* const> last, std::int64_t begin_ns,
                  std::int64_t end_ns, const MemoryBudget& memory = {}, const Box& scene = {},
                  std::uint64_t snapshot = 1);

}  // namespace hl
