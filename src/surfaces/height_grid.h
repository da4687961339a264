// HeightGrid: samples of a height on a rectangular grid, as a file or a sensor gives them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "surfaces/samples.h"

namespace hl {

/// The form of a grid. The samples of a row follow each other, and so do the rows.
struct GridSize {
  std::uint32_t columns = 0, rows = 0;  ///< samples, each 2 to kMaxGridSide
  SampleKind kind = SampleKind::kFloat32;

  std::size_t samples() const { return std::size_t{columns} * rows; }
  std::size_t bytes() const { return samples() * sizeOf(kind); }
};

/// A pyramid over so many samples has at most kMaxPyramidLevels levels.
inline constexpr std::uint32_t kMaxGridSide = 1U << 30;

/// Throws hl::Error for a size that no grid has.
void checkGridSize(const GridSize& size);

/// Immutable; read by any thread. Heights are in the units of the samples: a GridFrame makes metres of them.
class HeightGrid {
 public:
  /// `samples` has `size.bytes()` bytes, aligned as its kind; it is shared, not copied. `missing`: the value that
  /// stands for "no sample"; not a number always does. Throws hl::Error for a size that cannot be.
  HeightGrid(const GridSize& size, std::shared_ptr<const void> samples, std::optional<double> missing = {});

  const GridSize& size() const { return size_; }
  std::uint32_t columns() const { return size_.columns; }
  std::uint32_t rows() const { return size_.rows; }
  std::optional<double> missing() const { return samples_.missing(); }
  const void* samples() const { return samples_.data(); }
  const Samples& list() const { return samples_; }

  /// The sample, or not a number where it is missing. RT-safe.
  double at(std::uint32_t column, std::uint32_t row) const {
    return samples_[std::size_t{row} * size_.columns + column];
  }
  /// Whether all four samples around a cell exist: only then it has triangles. RT-safe.
  bool hasCell(std::uint32_t column, std::uint32_t row) const {
    return !std::isnan(at(column, row) + at(column + 1, row) + at(column, row + 1) + at(column + 1, row + 1));
  }
  std::size_t bytes() const { return sizeof(*this) + size_.bytes(); }

 private:
  GridSize size_;
  Samples samples_;
};

}  // namespace hl
