// VoxelGrid: samples of a quantity on a grid in space, as CT, MRI and distance fields have them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "surfaces/samples.h"

namespace hl {

/// No side has more samples: numbers of cells stay below 2^60.
inline constexpr std::uint32_t kMaxVoxelSide = 1U << 20;

/// Samples along x, y and z, each 2 to kMaxVoxelSide; else throws hl::Error.
void checkVoxelSides(const std::array<std::uint32_t, 3>& side);

/// How values follow from samples: value = offset + scale * sample, as CT numbers (HU) do.
struct ValueScale {
  double scale = 1, offset = 0;
};

/// Immutable; read by any thread. Samples follow each other along x, then y, then z.
class VoxelGrid {
 public:
  /// `samples` has as many as the product of the sides. Throws hl::Error for a size or scale that cannot be.
  VoxelGrid(const std::array<std::uint32_t, 3>& side, Samples samples, const ValueScale& values = {});

  std::uint32_t side(std::size_t axis) const { return side_[axis]; }
  std::uint32_t cells(std::size_t axis) const { return side_[axis] - 1; }
  const Samples& samples() const { return samples_; }
  const ValueScale& values() const { return values_; }
  std::size_t count() const { return std::size_t{side_[0]} * side_[1] * side_[2]; }
  std::size_t bytes() const { return sizeof(*this) + count() * sizeOf(samples_.kind()); }

  /// Value at a sample; not a number where it is missing. RT-safe.
  double at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return at(placeOf(x, y, z)); }
  /// The values at the corners of a cell; corner c has the offsets (c & 1, c >> 1 & 1, c >> 2 & 1). RT-safe.
  std::array<double, 8> cornersOf(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const std::size_t place = placeOf(x, y, z), row = side_[0], slice = row * side_[1];
    return samples_.as([&](const auto* samples) -> std::array<double, 8> {
      const auto* const first = samples + place;
      const auto at = [&](std::size_t corner) {
        return values_.offset + values_.scale * samples_.number(first[corner]);
      };
      return {at(0), at(1), at(row), at(row + 1), at(slice), at(slice + 1), at(slice + row), at(slice + row + 1)};
    });
  }

 private:
  std::size_t placeOf(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * side_[1] + y) * side_[0] + x;
  }
  double at(std::size_t place) const { return values_.offset + values_.scale * samples_[place]; }

  std::array<std::uint32_t, 3> side_;
  Samples samples_;
  ValueScale values_;
};

}  // namespace hl
