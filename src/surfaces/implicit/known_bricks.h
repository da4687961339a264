// KnownBricks: the large bricks of a sheet in which it is, with bounds of the second derivatives there, so that walks
// need no intervals of their own for them. find_bricks.h finds them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hl {

/// A brick that holds a sheet.
struct KnownBrick {
  int level;
  std::array<std::uint32_t, 3> at;  ///< below 2^16
  /// Bound of the sum of the second derivatives' absolute values; infinite where slopes give a tighter bound.
  double bend;
};

/// Immutable; read by any thread.
class KnownBricks {
 public:
  /// All that there are of level `lowest` and above.
  KnownBricks(int lowest, const std::vector<KnownBrick>& bricks);

  int lowest() const { return lowest_; }
  /// The bend of a brick of a level that is known; null if the sheet is not in it. RT-safe.
  const double* find(int level, const std::array<std::uint32_t, 3>& at) const;
  std::size_t bytes() const { return sizeof(*this) + slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    std::uint64_t number;
    double bend;
  };
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

  std::size_t slotOf(std::uint64_t number) const;

  int lowest_;
  std::vector<Slot> slots_;  // a power of two; the first free one after a brick's own holds it
};

}  // namespace hl
