// CrossedCells: which cells of a brick a surface of equal value crosses, by comparisons of bits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "surfaces/sample_bound.h"

namespace hl {

/// Cells with a missing sample may be among them. RT-safe.
class CrossedCells {
 public:
  using Place = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kMax = 4;  ///< cells along each axis

  /// Of the cells from `first` to before `end`.
  CrossedCells(const VoxelGrid& grid, const SampleBound& bound, const Place& first, const Place& end) : first_(first) {
    const std::size_t row = grid.side(0), slice = row * grid.side(1);
    const std::size_t place = first[2] * slice + first[1] * row + first[0];
    const Place count{end[0] - first[0], end[1] - first[1], end[2] - first[2]};
    grid.samples().as([&](const auto* samples) { find(samples + place, row, slice, count, bound); });
  }

  /// Calls visit(cell) for each.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (std::uint32_t z = 0; z < kMax; ++z) {
      for (std::uint32_t left = crossed_[z]; left != 0; left &= left - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
        visit(Place{first_[0] + bit % kRow, first_[1] + bit / kRow, first_[2] + z});
      }
    }
  }

 private:
  static constexpr std::uint32_t kRow = kMax + 1;  // samples, and bits

  // A bit for each sample of a slice, then for each of its cells.
  template <typename Sample>
  void find(const Sample* samples, std::size_t row, std::size_t slice, const Place& count, const SampleBound& bound) {
    const auto least = leastOf<Sample>(bound);
    std::uint32_t inner = 0;  // the cells that are asked for
    for (std::uint32_t y = 0; y < count[1]; ++y) inner |= ((1U << count[0]) - 1) << (kRow * y);
    std::uint32_t before = 0;
    for (std::uint32_t z = 0; z <= count[2]; ++z) {
      std::uint32_t beyond = 0;
      for (std::uint32_t y = 0; y <= count[1]; ++y)
        beyond |= rowOf(samples + z * slice + y * row, count[0], least) << (kRow * y);
      if (z > 0) crossed_[z - 1] = between(before, beyond) & inner;
      before = beyond;
    }
  }

  // A whole row needs no loop.
  template <typename Sample, typename Least>
  static std::uint32_t rowOf(const Sample* samples, std::uint32_t cells, Least least) {
    const auto bit = [&](std::uint32_t x) { return std::uint32_t{samples[x] >= least} << x; };
    if (cells == kMax) return bit(0) | bit(1) | bit(2) | bit(3) | bit(4);
    std::uint32_t beyond = 0;
    for (std::uint32_t x = 0; x <= cells; ++x) beyond |= bit(x);
    return beyond;
  }

  template <typename Sample>
  static auto leastOf(const SampleBound& bound) {
    if constexpr (std::is_floating_point_v<Sample>) {
      return bound.real;
    } else {
      return bound.whole;
    }
  }

  // Cells between two slices of which some corners are beyond the bound and some are not.
  static std::uint32_t between(std::uint32_t slice, std::uint32_t other) {
    std::uint32_t some = slice | other, all = slice & other;
    some |= some >> 1U;
    all &= all >> 1U;
    some |= some >> kRow;
    all &= all >> kRow;
    return some & ~all;
  }

  const Place first_;
  std::array<std::uint32_t, kMax> crossed_{};  // of each slice of cells, a bit for each
};

}  // namespace hl
