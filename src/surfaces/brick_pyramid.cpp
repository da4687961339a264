#include "surfaces/brick_pyramid.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

constexpr float kNoEnd = std::numeric_limits<float>::infinity();

std::uint32_t bricksFor(std::uint32_t parts, std::uint32_t per_brick) { return (parts + per_brick - 1) / per_brick; }

float floorOf(double value) {
  const auto near = static_cast<float>(value);
  return near <= value ? near : std::nextafter(near, -kNoEnd);
}
float ceilingOf(double value) {
  const auto near = static_cast<float>(value);
  return near >= value ? near : std::nextafter(near, kNoEnd);
}

/// The parts of a brick along one axis, from `begin` to before `end`.
struct Span {
  std::uint32_t begin, end;
};

Span partsOf(std::uint32_t brick, std::uint32_t per_brick, std::uint32_t parts) {
  return {brick * per_brick, std::min((brick + 1) * per_brick, parts)};
}

// A missing sample is neither the least nor the greatest.
ValueRange rangeOfSamples(const VoxelGrid& grid, const Span& x, const Span& y, const Span& z) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::uint32_t k = z.begin; k <= z.end; ++k) {
    for (std::uint32_t j = y.begin; j <= y.end; ++j) {
      for (std::uint32_t i = x.begin; i <= x.end; ++i) {
        const double value = grid.at(i, j, k);
        low = value < low ? value : low;
        high = value > high ? value : high;
      }
    }
  }
  return {floorOf(low), ceilingOf(high)};
}

// Calls set(x, y, z) for each brick, slices on several threads.
template <typename Set>
void forEachBrick(const std::array<std::uint32_t, 3>& side, const Set& set) {
  using Range = oneapi::tbb::blocked_range<std::uint32_t>;
  oneapi::tbb::parallel_for(Range(0, side[2]), [&](const Range& slices) {
    for (std::uint32_t z = slices.begin(); z < slices.end(); ++z) {
      for (std::uint32_t y = 0; y < side[1]; ++y) {
        for (std::uint32_t x = 0; x < side[0]; ++x) set(x, y, z);
      }
    }
  });
}

}  // namespace

BrickPyramid::BrickPyramid(const VoxelGrid& grid) : cells_{grid.cells(0), grid.cells(1), grid.cells(2)} {
  levels_.push_back(overSamples(grid));
  while (levels_.back().ranges.size() > 1) levels_.push_back(above(levels_.back()));
  measureSlices();
  countRanges();
}

void BrickPyramid::measureSlices() {
  const Level& bricks = levels_.front();
  for (std::size_t axis = 0; axis < 3; ++axis) slices_[axis].assign(bricks.side[axis], {kNoEnd, -kNoEnd});
  forEachPlace({0, 0, 0}, bricks.side, [&](const Place& at) {
    const ValueRange& brick = range(0, at[0], at[1], at[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ValueRange& slice = slices_[axis][at[axis]];
      slice = {std::min(slice.low, brick.low), std::max(slice.high, brick.high)};
    }
  });
}

BrickPyramid::Region BrickPyramid::regionHolding(double value) const {
  Region region{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto holds = [value](const ValueRange& slice) { return slice.holds(value); };
    const auto& slices = slices_[axis];
    const auto first = std::find_if(slices.begin(), slices.end(), holds);
    if (first == slices.end()) return {};
    const auto end = std::find_if(slices.rbegin(), slices.rend(), holds).base();
    region.first[axis] = kCells * static_cast<std::uint32_t>(first - slices.begin());
    region.end[axis] = std::min(kCells * static_cast<std::uint32_t>(end - slices.begin()), cells_[axis]);
  }
  return region;
}

void BrickPyramid::countRanges() {
  constexpr std::size_t kMaxBins = 1024;
  const auto& bricks = levels_.front().ranges;
  std::vector<std::int64_t> change(std::min(kMaxBins, bricks.size()) + 1);
  holding_.resize(change.size() - 1);
  for (const ValueRange& brick : bricks) {
    if (!(brick.low <= brick.high)) continue;
    ++change[binOf(brick.low)];
    --change[binOf(brick.high) + 1];
  }
  std::int64_t count = 0;
  for (std::size_t bin = 0; bin < holding_.size(); ++bin) {
    count += change[bin];
    holding_[bin] = static_cast<std::uint32_t>(count);
  }
}

std::size_t BrickPyramid::binOf(double value) const {
  const double part = (value - range().low) / (double{range().high} - range().low);
  const auto bins = static_cast<double>(holding_.size());
  return part > 0 ? static_cast<std::size_t>(std::min(part * bins, bins - 1)) : 0;
}

std::uint64_t BrickPyramid::countHolding(double value) const {
  return range().holds(value) ? holding_[binOf(value)] : 0;
}

BrickPyramid::Level BrickPyramid::emptyLevel(const std::array<std::uint32_t, 3>& side) {
  Level level{side, {}};
  level.ranges.resize(std::size_t{side[0]} * side[1] * side[2]);
  return level;
}

BrickPyramid::Level BrickPyramid::overSamples(const VoxelGrid& grid) {
  Level level = emptyLevel(
      {bricksFor(grid.cells(0), kCells), bricksFor(grid.cells(1), kCells), bricksFor(grid.cells(2), kCells)});
  forEachBrick(level.side, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    level.ranges[(std::size_t{z} * level.side[1] + y) * level.side[0] + x] = rangeOfSamples(
        grid, partsOf(x, kCells, grid.cells(0)), partsOf(y, kCells, grid.cells(1)), partsOf(z, kCells, grid.cells(2)));
  });
  return level;
}

BrickPyramid::Level BrickPyramid::above(const Level& beneath) {
  Level level = emptyLevel(
      {bricksFor(beneath.side[0], kBricks), bricksFor(beneath.side[1], kBricks), bricksFor(beneath.side[2], kBricks)});
  forEachBrick(level.side, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const Span across = partsOf(x, kBricks, beneath.side[0]), along = partsOf(y, kBricks, beneath.side[1]),
               up = partsOf(z, kBricks, beneath.side[2]);
    ValueRange range{kNoEnd, -kNoEnd};
    for (std::uint32_t k = up.begin; k < up.end; ++k) {
      for (std::uint32_t j = along.begin; j < along.end; ++j) {
        for (std::uint32_t i = across.begin; i < across.end; ++i) {
          const ValueRange& part = beneath.ranges[(std::size_t{k} * beneath.side[1] + j) * beneath.side[0] + i];
          range = {std::min(range.low, part.low), std::max(range.high, part.high)};
        }
      }
    }
    level.ranges[(std::size_t{z} * level.side[1] + y) * level.side[0] + x] = range;
  });
  return level;
}

std::size_t BrickPyramid::bytes() const {
  std::size_t ranges = bricks();
  for (const auto& slices : slices_) ranges += slices.size();
  return sizeof(*this) + ranges * sizeof(ValueRange) + holding_.size() * sizeof(std::uint32_t);
}

std::size_t BrickPyramid::bricks() const {
  std::size_t count = 0;
  for (const Level& level : levels_) count += level.ranges.size();
  return count;
}

}  // namespace hl
