#include "surfaces/threshold.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hl {

namespace {

constexpr std::size_t kBins = 1024, kMaxSamples = 4'000'000;

using ValueCounts = std::array<double, kBins>;

ValueCounts countsOf(const VoxelGrid& grid, double low, double high) {
  ValueCounts counts{};
  const std::size_t every = std::max<std::size_t>(1, grid.count() / kMaxSamples) | 1U;  // odd: no column by chance
  const Samples& samples = grid.samples();
  for (std::size_t place = 0; place < grid.count(); place += every) {
    const double value = grid.values().offset + grid.values().scale * samples[place];
    if (std::isnan(value)) continue;
    const auto bin = static_cast<std::size_t>(kBins * (value - low) / (high - low));
    ++counts[std::min(bin, kBins - 1)];
  }
  return counts;
}

}  // namespace

double thresholdOf(const Volume& volume) {
  const double low = volume.pyramid.range().low, high = volume.pyramid.range().high;
  if (!(high > low)) return std::isfinite(low) ? low : 0;
  const ValueCounts counts = countsOf(volume.grid, low, high);
  double all = 0, all_moment = 0;
  for (std::size_t i = 0; i < kBins; ++i) {
    all += counts[i];
    all_moment += counts[i] * static_cast<double>(i);
  }
  // Where the counts below are w and their mean is m: the variance between both sides, w (1 - w) (m - M)^2.
  double below = 0, moment = 0, best = -1;
  std::size_t first = kBins / 2, last = first;  // of the bins with the best: a gap between the sides has many
  for (std::size_t i = 0; i + 1 < kBins; ++i) {
    below += counts[i];
    moment += counts[i] * static_cast<double>(i);
    if (below == 0 || below == all) continue;
    const double apart = moment / below - (all_moment - moment) / (all - below);
    const double variance = below * (all - below) * apart * apart;
    if (variance > best) first = i;
    if (variance >= best) last = i;
    best = std::max(best, variance);
  }
  return low + (high - low) * (static_cast<double>(first + last) / 2 + 1) / kBins;
}

}  // namespace hl
