// Sweep and prune: which bodies are near each other: sorted by their lowest x, each is compared with those that begin
// before it ends. D. Baraff, Dynamic simulation of non-penetrating rigid bodies, thesis, Cornell, 1992.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/world.h"

namespace hl {

/// By one thread at a time.
class SweepAndPrune {
 public:
  explicit SweepAndPrune(const World& world);
  /// From now on the bodies are where they are in this state. RT-safe.
  void sort(const WorldState& state);
  /// Calls each(one, other) once for each pair that can touch after the two have gone `ways` (m, of each body; 0 of
  /// those that sleep). `one` is awake; the order of the pairs is not fixed. RT-safe.
  template <typename Each>
  void forEachPair(const WorldState& state, std::span<const double> ways, Each each) const;

 private:
  bool isNear(const WorldState& state, std::span<const double> ways, std::uint32_t one, std::uint32_t other) const {
    const double near = reach_[one] + reach_[other] + ways[one] + ways[other];
    return (state.bodies[one].centre - state.bodies[other].centre).squaredNorm() <= near * near;
  }

  std::vector<std::uint32_t> along_x_;
  std::vector<double> reach_, low_x_;  // m
  double widest_ = 0;                  // m, greatest reach
  bool sorted_ = false;                // along_x_ was, at least once
};

// Each that is awake meets those that begin before it ends, and of those before it the sleeping ones.
template <typename Each>
void SweepAndPrune::forEachPair(const WorldState& state, std::span<const double> ways, Each each) const {
  const double farthest = ways.empty() ? 0 : *std::max_element(ways.begin(), ways.end());
  const auto sleeps = [&](std::uint32_t body) { return state.bodies[body].island != 0; };
  for (std::size_t i = 0; i < along_x_.size(); ++i) {
    const std::uint32_t one = along_x_[i];
    if (sleeps(one)) continue;
    const double begin = low_x_[one] - 2 * widest_ - ways[one];
    const double end = low_x_[one] + 2 * reach_[one] + ways[one] + farthest;
    for (std::size_t j = i + 1; j < along_x_.size() && low_x_[along_x_[j]] <= end; ++j) {
      if (isNear(state, ways, one, along_x_[j])) each(one, along_x_[j]);
    }
    for (std::size_t j = i; j > 0 && low_x_[along_x_[j - 1]] >= begin; --j) {
      const std::uint32_t other = along_x_[j - 1];
      if (sleeps(other) && isNear(state, ways, one, other)) each(one, other);
    }
  }
}

}  // namespace hl
