// The packed normals (packed_normal.h) of a block of neighbours, in few bits and without loss: neighbours mostly point
// along one line, to this side or the other.
//
// A packed normal is a point x, y, z of whole numbers on the octahedron |x| + |y| + |z| = kUnitSteps. A block has an
// axis. Of each point the side of that axis is kept, in one bit, and how far the point lies along the other two axes,
// turned to the positive side: each from the least of the block and in as many bits as the largest needs. What cannot
// come back from that, as kNoNormal, or would take no less, makes the block keep all 32 bits of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "surfaces/packed_bits.h"
#include "surfaces/packed_normal.h"

namespace hl {

/// The head of a block's normals, which follow it.
class BlockNormals {
 public:
  explicit BlockNormals(std::span<const std::uint32_t> normals);
  /// As write() left it.
  BlockNormals(const std::uint8_t* bytes, std::uint64_t first_bit) {
    std::uint64_t head = readBits(bytes, first_bit, kHeadBits);
    const auto next = [&](unsigned width) {
      const auto number = static_cast<std::uint32_t>(lowBits(head, width));
      head >>= width;
      return number;
    };
    axis_ = next(kAxisBits);
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = static_cast<std::int32_t>(next(kPartBits[k])) - kOffset[k];
      width_[k] = next(kWidthBits[k]);
    }
  }

  /// Of `count` normals and their head.
  std::uint64_t bits(std::size_t count) const { return kHeadBits + std::uint64_t{each()} * count; }

  /// Where all bits are 0.
  void write(std::span<const std::uint32_t> normals, std::uint8_t* bytes, std::uint64_t first_bit) const;

  /// Of the normal with this number. RT-safe.
  std::uint32_t read(const std::uint8_t* bytes, std::uint64_t first_bit, std::size_t number) const {
    std::uint64_t kept = readBits(bytes, first_bit + bits(number), each());
    if (axis_ == kWhole) return static_cast<std::uint32_t>(kept);
    Parts parts{};
    for (std::size_t k = 0; k < 3; ++k) {
      parts[k] = low_[k] + static_cast<std::int32_t>(lowBits(kept, width_[k]));
      kept >>= width_[k];
    }
    const std::int32_t sign = parts[0] == 0 ? 1 : -1;
    Point point{};
    point[axis_] = sign * (kUnit - std::abs(parts[1]) - std::abs(parts[2]));
    point[(axis_ + 1) % 3] = sign * parts[1];
    point[(axis_ + 2) % 3] = sign * parts[2];
    return normalOf(point);
  }

 private:
  using Point = std::array<std::int32_t, 3>;
  using Parts = std::array<std::int32_t, 3>;  // the side of the axis, 0 or 1; steps along the other two

  static constexpr std::int32_t kUnit = static_cast<std::int32_t>(kUnitSteps);
  static constexpr std::int32_t kZero = static_cast<std::int32_t>(kZeroStep);
  static constexpr std::uint32_t kWhole = 3;  // in the place of an axis
  static constexpr unsigned kWholeBits = 32, kAxisBits = 2;
  static constexpr std::array<unsigned, 3> kPartBits{1, 16, 16}, kWidthBits{1, 5, 5};
  static constexpr std::array<std::int32_t, 3> kOffset{0, kUnit, kUnit};
  static constexpr unsigned kHeadBits = kAxisBits + 1 + 16 + 16 + 1 + 5 + 5;
  static_assert(kHeadBits <= kWidestBits);

  static std::int32_t signOf(std::int32_t number) { return number < 0 ? -1 : 1; }
  static Point pointOf(std::uint32_t normal);
  static std::uint32_t normalOf(const Point& point) {
    std::int32_t u = point[0], v = point[1];
    if (point[2] < 0) {
      u = (kUnit - std::abs(point[1])) * signOf(point[0]);
      v = (kUnit - std::abs(point[0])) * signOf(point[1]);
    }
    return static_cast<std::uint32_t>(u + kZero) << 16 | static_cast<std::uint32_t>(v + kZero);
  }
  static std::uint32_t largestOf(const Point& point);
  Parts partsOf(const Point& point) const;
  void keepWhole();
  unsigned each() const { return axis_ == kWhole ? kWholeBits : width_[0] + width_[1] + width_[2]; }

  std::uint32_t axis_ = 0;
  std::array<std::int32_t, 3> low_{};
  std::array<unsigned, 3> width_{};
};

}  // namespace hl
