// CloudPoints: the points of a cloud on a lattice, in blocks of neighbours with their bounds, in as few bits as each
// block needs. A laser scanner's file is such a lattice, so nothing is rounded.
//
// A block has its low corner and size. Its points follow each other as offsets from that corner, along each axis in as
// many bits as the size has, and then their normals (block_normals.h).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/huge_pages.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "surfaces/block_normals.h"
#include "surfaces/packed_bits.h"

namespace hl {

/// p = origin + step * at, for each axis. Metres.
struct CloudLattice {
  Vec3 step, origin;
};

/// Bounds in steps, both ends within.
struct LatticeBox {
  std::array<std::int32_t, 3> low, high;
};

/// Immutable; made by makeCloud() of cloud_maker.h. Slots are numbered kPerBlock to a block, whose last ones may be
/// empty. RT-safe.
class CloudPoints {
 public:
  static constexpr std::size_t kPerBlock = 16, kPerNode = 8;
  static constexpr int kMaxLevels = 12;

  std::size_t blocks() const { return blocks_.size(); }
  std::size_t size() const { return size_; }
  std::size_t countIn(std::size_t block) const { return blocks_[block].count; }
  Vec3 at(std::size_t slot) const;
  std::array<std::int32_t, 3> stepsAt(std::size_t slot) const;
  /// Packed; kNoNormal only if no neighbours were there to compute it from.
  std::uint32_t normal(std::size_t slot) const;
  /// Whether its source has colours.
  bool hasColours() const { return !colours_.empty(); }
  Rgb colour(std::size_t slot) const { return colours_[slot]; }
  /// Distance between neighbours in this block, m: of as many points on a square grid.
  double spacing(std::size_t block) const { return spacings_[blocks_[block].spacing]; }
  /// Of most of the blocks.
  double usualSpacing() const { return usual_spacing_; }

  /// Above the blocks, level 0, there are levels() - 1 of nodes over kPerNode parts each; the last has one.
  int levels() const { return static_cast<int>(nodes_.size()) + 1; }
  std::size_t countOn(int level) const {
    return level == 0 ? blocks() : nodes_[static_cast<std::size_t>(level) - 1].size();
  }
  LatticeBox box(int level, std::size_t number) const;

  const CloudLattice& lattice() const { return lattice_; }
  /// Bound of the distance between a point that was given and where it is now.
  double error_m() const { return error_m_; }
  std::size_t bytes() const;

  /// The slots of one block, faster than by at() and normal(). Valid as long as the points are.
  class BlockReader {
   public:
    BlockReader(const CloudPoints& points, std::size_t block);
    Vec3 at(std::size_t i) const;
    std::uint32_t normal(std::size_t i) const { return normals_.read(bytes_, normals_bit_, i); }

   private:
    std::array<std::int32_t, 3> low_;
    std::array<unsigned, 3> width_;
    unsigned all_;
    const std::uint8_t* bytes_;  // of all blocks
    std::uint64_t first_bit_, normals_bit_;
    BlockNormals normals_;
  };

 private:
  friend class CloudMaker;

  struct Block {
    std::array<std::int32_t, 3> low;
    std::array<std::uint16_t, 3> size;
    std::uint8_t count, spacing;  // spacing: a number of spacings_
    std::uint32_t begin;          // in packed_, in units

    std::array<unsigned, 3> widths() const {
      const auto width = [](std::uint16_t side) { return static_cast<unsigned>(std::bit_width(side)); };
      return {width(size[0]), width(size[1]), width(size[2])};
    }
    unsigned offsetBits() const {
      const std::array<unsigned, 3> width = widths();
      return width[0] + width[1] + width[2];
    }
  };
  static constexpr std::uint64_t kUnit_bits = 32;
  static constexpr unsigned kMostOffsetBits = 3 * 16;  // of a point
  static_assert(kMostOffsetBits <= kWidestBits);

  CloudLattice lattice_;
  double error_m_ = 0, usual_spacing_ = 0;
  std::size_t size_ = 0;
  HugeVector<Block> blocks_;
  HugeVector<std::uint8_t> packed_;            // offsets and normals of all slots, and kReadBehind_bytes
  HugeVector<Rgb> colours_;                    // by slot, or none
  std::vector<HugeVector<LatticeBox>> nodes_;  // from the blocks up
  std::array<double, 256> spacings_{};         // m
};

// Inline, as each query reads many of them.

inline std::array<std::int32_t, 3> CloudPoints::stepsAt(std::size_t slot) const {
  const Block& block = blocks_[slot / kPerBlock];
  const std::array<unsigned, 3> width = block.widths();
  const unsigned all = width[0] + width[1] + width[2];
  const std::uint64_t offsets = readBits(packed_.data(), kUnit_bits * block.begin + slot % kPerBlock * all, all);
  const auto offset = [&](unsigned before, unsigned bits) {
    return static_cast<std::int32_t>(lowBits(offsets >> before, bits));
  };
  return {block.low[0] + offset(0, width[0]), block.low[1] + offset(width[0], width[1]),
          block.low[2] + offset(width[0] + width[1], width[2])};
}

inline std::uint32_t CloudPoints::normal(std::size_t slot) const {
  const Block& block = blocks_[slot / kPerBlock];
  const std::uint64_t first = kUnit_bits * block.begin + kPerBlock * block.offsetBits();
  return BlockNormals(packed_.data(), first).read(packed_.data(), first, slot % kPerBlock);
}

inline Vec3 CloudPoints::at(std::size_t slot) const {
  const std::array<std::int32_t, 3> steps = stepsAt(slot);
  return {static_cast<double>(steps[0]), static_cast<double>(steps[1]), static_cast<double>(steps[2])};
}

inline CloudPoints::BlockReader::BlockReader(const CloudPoints& points, std::size_t block)
    : low_(points.blocks_[block].low),
      width_(points.blocks_[block].widths()),
      all_(width_[0] + width_[1] + width_[2]),
      bytes_(points.packed_.data()),
      first_bit_(kUnit_bits * points.blocks_[block].begin),
      normals_bit_(first_bit_ + kPerBlock * all_),
      normals_(bytes_, normals_bit_) {}

inline Vec3 CloudPoints::BlockReader::at(std::size_t i) const {
  const std::uint64_t offsets = readBits(bytes_, first_bit_ + i * all_, all_);
  const auto along = [&](std::size_t axis, unsigned before) {
    return static_cast<double>(low_[axis] + static_cast<std::int32_t>(lowBits(offsets >> before, width_[axis])));
  };
  return {along(0, 0), along(1, width_[0]), along(2, width_[0] + width_[1])};
}

inline LatticeBox CloudPoints::box(int level, std::size_t number) const {
  if (level > 0) return nodes_[static_cast<std::size_t>(level) - 1][number];
  const Block& block = blocks_[number];
  return {block.low, {block.low[0] + block.size[0], block.low[1] + block.size[1], block.low[2] + block.size[2]}};
}

}  // namespace hl
