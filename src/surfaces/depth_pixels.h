// DepthPixels: the depths that a camera sees.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace hl {

/// In metres, row by row from the top; above 0, or 0: none. Written by whoever makes them, and then read by any thread.
class DepthPixels {
 public:
  /// Nothing is written yet. Throws bad_alloc.
  DepthPixels(std::uint32_t columns, std::uint32_t rows)
      : columns_(columns), rows_(rows), depths_(std::make_unique_for_overwrite<float[]>(count() + kBeyond)) {
    std::fill_n(depths_.get() + count(), kBeyond, 0.0F);
  }

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::size_t count() const { return std::size_t{columns_} * rows_; }
  /// So many more may be read behind the last, which are none: vectors may end there.
  static constexpr std::size_t kBeyond = 16;
  std::size_t bytes() const { return count() * sizeof(float); }
  /// RT-safe.
  float at(std::uint32_t column, std::uint32_t row) const { return this->row(row)[column]; }
  const float* row(std::uint32_t row) const { return depths_.get() + std::size_t{row} * columns_; }
  float* all() { return depths_.get(); }
  const float* all() const { return depths_.get(); }

 private:
  std::uint32_t columns_, rows_;
  std::unique_ptr<float[]> depths_;
};

}  // namespace hl
