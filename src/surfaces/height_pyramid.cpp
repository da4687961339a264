#include "surfaces/height_pyramid.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hl {

namespace {

using Range = oneapi::tbb::blocked_range<std::uint32_t>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr HeightSlab kEmptySlab{kInfinity, -kInfinity, 0, 0};

std::uint32_t blocksFor(std::uint64_t parts, std::uint64_t per_block) {
  return static_cast<std::uint32_t>((parts + per_block - 1) / per_block);
}

// Beyond what rounding may do to a sum of terms up to `size`.
constexpr double kSumRounding = 1e-14;
float roundedDown(double value, double size) {
  return std::nextafter(static_cast<float>(value - kSumRounding * size), -kInfinity);
}
float roundedUp(double value, double size) {
  return std::nextafter(static_cast<float>(value + kSumRounding * size), kInfinity);
}

/// What a part of the grid has.
struct HeightTally {
  std::uint64_t cells = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  void add(const HeightTally& other) {
    cells += other.cells;
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

/// The samples of a block of cells: one more than cells along each side.
class BlockSamples {
 public:
  BlockSamples(const HeightGrid& grid, std::uint32_t column, std::uint32_t row)
      : columns_(std::min(kSide, grid.columns() - column)), rows_(std::min(kSide, grid.rows() - row)) {
    for (std::uint32_t j = 0; j < rows_; ++j) {
      for (std::uint32_t i = 0; i < columns_; ++i) {
        const double value = grid.at(column + i, row + j);
        value_[j][i] = value;
        missing_ = missing_ || std::isnan(value);
      }
    }
    if (missing_) dropLone();
  }

  HeightSlab slab(HeightTally& tally) const {
    const std::uint64_t cells = cellCount();
    if (cells == 0) return kEmptySlab;
    tally.cells += cells;
    const float across = missing_ ? 0
                                  : slope(value_[0][0], value_[0][columns_ - 1], value_[rows_ - 1][0],
                                          value_[rows_ - 1][columns_ - 1], columns_ - 1);
    const float down = missing_ ? 0
                                : slope(value_[0][0], value_[rows_ - 1][0], value_[0][columns_ - 1],
                                        value_[rows_ - 1][columns_ - 1], rows_ - 1);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t j = 0; j < rows_; ++j) {
      for (std::uint32_t i = 0; i < columns_; ++i) {
        const double value = value_[j][i], rest = value - double{across} * i - double{down} * j;
        low = rest < low ? rest : low;  // a missing sample is neither
        high = rest > high ? rest : high;
        tally.lowest = value < tally.lowest ? value : tally.lowest;
        tally.highest = value > tally.highest ? value : tally.highest;
      }
    }
    const double size = std::abs(low) + std::abs(high) + kSide * (std::abs(across) + std::abs(down));
    return {roundedDown(low, size), roundedUp(high, size), across, down};
  }

 private:
  static constexpr std::uint32_t kSide = HeightPyramid::kCells + 1;

  bool hasCell(std::uint32_t i, std::uint32_t j) const {
    return !std::isnan(value_[j][i] + value_[j][i + 1] + value_[j + 1][i] + value_[j + 1][i + 1]);
  }
  // Samples that belong to no cell count as missing.
  void dropLone() {
    bool used[kSide][kSide] = {};
    for (std::uint32_t j = 0; j + 1 < rows_; ++j) {
      for (std::uint32_t i = 0; i + 1 < columns_; ++i) {
        if (hasCell(i, j)) used[j][i] = used[j][i + 1] = used[j + 1][i] = used[j + 1][i + 1] = true;
      }
    }
    for (std::uint32_t j = 0; j < rows_; ++j) {
      for (std::uint32_t i = 0; i < columns_; ++i) {
        if (!used[j][i]) value_[j][i] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  std::uint64_t cellCount() const {
    if (!missing_) return std::uint64_t{columns_ - 1} * (rows_ - 1);
    std::uint64_t cells = 0;
    for (std::uint32_t j = 0; j + 1 < rows_; ++j) {
      for (std::uint32_t i = 0; i + 1 < columns_; ++i) cells += hasCell(i, j) ? 1 : 0;
    }
    return cells;
  }
  // The mean over both sides, in steps from one end to the other.
  static float slope(double a0, double a1, double b0, double b1, std::uint32_t steps) {
    const auto mean = static_cast<float>(((a1 - a0) + (b1 - b0)) / (2.0 * steps));
    return std::isfinite(mean) ? mean : 0;
  }

  std::uint32_t columns_, rows_;
  bool missing_ = false;
  std::array<std::array<double, kSide>, kSide> value_;
};

/// A slab in double precision: sums of such are exact enough to be rounded outward once.
struct WideSlab {
  double low, high, slope_column, slope_row;

  double lowest(double columns, double rows) const {
    return low + std::min(slope_column * columns, 0.0) + std::min(slope_row * rows, 0.0);
  }
  double highest(double columns, double rows) const {
    return high + std::max(slope_column * columns, 0.0) + std::max(slope_row * rows, 0.0);
  }
};

}  // namespace

HeightPyramid::HeightPyramid(const HeightGrid& grid) {
  measure(grid);
  while (levels_.back().slabs.size() > 1) levels_.push_back(above(levels() - 1, grid));
}

void HeightPyramid::measure(const HeightGrid& grid) {
  Level level{blocksFor(grid.columns() - 1, kCells), blocksFor(grid.rows() - 1, kCells), {}};
  level.slabs.resize(std::size_t{level.columns} * level.rows);
  const HeightTally all = oneapi::tbb::parallel_reduce(
      Range(0, level.rows), HeightTally{},
      [&](const Range& range, HeightTally tally) {
        for (std::uint32_t row = range.begin(); row < range.end(); ++row) {
          for (std::uint32_t column = 0; column < level.columns; ++column)
            level.slabs[std::size_t{row} * level.columns + column] =
                BlockSamples(grid, column * kCells, row * kCells).slab(tally);
        }
        return tally;
      },
      [](HeightTally a, const HeightTally& b) {
        a.add(b);
        return a;
      });
  cells_ = all.cells;
  if (cells_ > 0) {
    lowest_ = all.lowest;
    highest_ = all.highest;
  }
  levels_.push_back(std::move(level));
}

// The slope of a block is the mean of those of the blocks in it.
HeightSlab HeightPyramid::joined(int level, std::uint32_t column, std::uint32_t row, const GridSize& size) const {
  const Level& in = levels_[static_cast<std::size_t>(level)];
  const std::uint32_t i1 = std::min((column + 1) * kBlocks, in.columns), j1 = std::min((row + 1) * kBlocks, in.rows);
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t j = row * kBlocks; j < j1; ++j) {
      for (std::uint32_t i = column * kBlocks; i < i1; ++i) {
        if (const HeightSlab& slab = in.slabs[std::size_t{j} * in.columns + i]; !slab.empty()) visit(slab, i, j);
      }
    }
  };
  double across = 0, down = 0;
  int used = 0;
  for_each([&](const HeightSlab& slab, std::uint32_t, std::uint32_t) {
    across += slab.slope_column;
    down += slab.slope_row;
    ++used;
  });
  if (used == 0) return kEmptySlab;
  HeightSlab all{0, 0, static_cast<float>(across / used), static_cast<float>(down / used)};
  const auto cells = static_cast<double>(side(level));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for_each([&](const HeightSlab& slab, std::uint32_t i, std::uint32_t j) {
    const WideSlab rest{slab.low, slab.high, double{slab.slope_column} - all.slope_column,
                        double{slab.slope_row} - all.slope_row};
    const double columns = std::min(cells, size.columns - 1 - cells * i);
    const double rows = std::min(cells, size.rows - 1 - cells * j);
    const double shift =
        all.slope_column * cells * (i - column * kBlocks) + all.slope_row * cells * (j - row * kBlocks);
    low = std::min(low, rest.lowest(columns, rows) - shift);
    high = std::max(high, rest.highest(columns, rows) - shift);
  });
  const double terms =
      std::abs(low) + std::abs(high) + kBlocks * cells * (std::abs(all.slope_column) + std::abs(all.slope_row));
  all.low = roundedDown(low, terms);
  all.high = roundedUp(high, terms);
  return all;
}

HeightPyramid::Level HeightPyramid::above(int level, const HeightGrid& grid) const {
  const Level& in = levels_[static_cast<std::size_t>(level)];
  Level out{blocksFor(in.columns, kBlocks), blocksFor(in.rows, kBlocks), {}};
  out.slabs.resize(std::size_t{out.columns} * out.rows);
  oneapi::tbb::parallel_for(Range(0, out.rows), [&](const Range& range) {
    for (std::uint32_t row = range.begin(); row < range.end(); ++row) {
      for (std::uint32_t column = 0; column < out.columns; ++column)
        out.slabs[std::size_t{row} * out.columns + column] = joined(level, column, row, grid.size());
    }
  });
  return out;
}

std::size_t HeightPyramid::bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const Level& level : levels_) bytes += level.slabs.capacity() * sizeof(HeightSlab);
  return bytes;
}

}  // namespace hl
