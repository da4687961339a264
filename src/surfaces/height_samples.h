// HeightSamples: the memory of a grid's samples while they come in, in pieces, from a file or a connection.
#pragma once

#include <cstddef>
#include <memory>

#include "surfaces/height_grid.h"

namespace hl {

class HeightSamples {
 public:
  /// Throws hl::Error for a size that no grid has, and bad_alloc.
  explicit HeightSamples(const GridSize& size);
  /// The next samples, row by row. Throws hl::Error if there are too many.
  void add(const void* samples, std::size_t bytes);
  bool whole() const { return filled_ == size_.bytes(); }
  const GridSize& size() const { return size_; }
  /// When it is whole, once; for HeightGrid. Nothing is copied.
  std::shared_ptr<const void> take();

 private:
  GridSize size_;
  std::shared_ptr<std::byte> memory_;
  std::size_t filled_ = 0;
};

}  // namespace hl
