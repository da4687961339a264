#include "bodies/sweep_and_prune.h"

#include <numeric>
#include <utility>

namespace hl {

SweepAndPrune::SweepAndPrune(const World& world) : along_x_(world.bodies.size()), low_x_(world.bodies.size()) {
  std::iota(along_x_.begin(), along_x_.end(), 0u);
  for (const Body& body : world.bodies) {
    reach_.push_back(body.shape.reach);
    widest_ = std::max(widest_, body.shape.reach);
  }
}

// The order of the step before is nearly right, so that sorting by insertion costs one pass. Before the first one there
// is none.
void SweepAndPrune::sort(const WorldState& state) {
  for (std::size_t i = 0; i < low_x_.size(); ++i) low_x_[i] = state.bodies[i].centre.x() - reach_[i];
  if (!std::exchange(sorted_, true)) {
    std::sort(along_x_.begin(), along_x_.end(), [&](std::uint32_t one, std::uint32_t other) {
      return std::pair(low_x_[one], one) < std::pair(low_x_[other], other);
    });
  }
  for (std::size_t i = 1; i < along_x_.size(); ++i) {
    for (std::size_t j = i; j > 0 && low_x_[along_x_[j]] < low_x_[along_x_[j - 1]]; --j)
      std::swap(along_x_[j], along_x_[j - 1]);
  }
}

}  // namespace hl
