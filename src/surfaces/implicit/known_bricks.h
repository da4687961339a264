// KnownBricks: the large bricks of a sheet in which it is, with bounds of the second derivatives there. They are found
// once, so that walks need no intervals of their own for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surfaces/implicit/sheet.h"

namespace hl {

/// Immutable; read by any thread.
class KnownBricks {
 public:
  using Place = Sheet::Place;

  /// From the largest brick down to level 1, or to the level at which there would be more than `most` in all. About
  /// 3 us for each of them. Setup only.
  KnownBricks(const Sheet& sheet, std::size_t most);

  /// All bricks of this level and above are known.
  int lowest() const { return lowest_; }
  /// Of a brick of a level that is known: bound of the sum of the second derivatives' absolute values, infinite where
  /// the slopes tell more; null if the sheet is not in it. RT-safe.
  const double* find(int level, const Place& at) const;
  std::size_t bytes() const { return sizeof(*this) + slots_.capacity() * sizeof(Slot); }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t brick = kEmpty;
    double bend = 0;
  };

  static std::uint64_t numberOf(int level, const Place& at) {
    return std::uint64_t(level) << 48 | std::uint64_t{at[2]} << 32 | std::uint64_t{at[1]} << 16 | at[0];
  }
  std::size_t slotOf(std::uint64_t brick) const;
  void fill(const std::vector<Slot>& found);

  int lowest_;
  std::vector<Slot> slots_;  // a power of two; the first free one after a brick's own holds it
};

}  // namespace hl
