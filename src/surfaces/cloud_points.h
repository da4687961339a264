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

  std::size_t blocks() const { return blocks_.size(); }
  std::size_t size() const { return size_; }
  std::size_t countIn(std::size_t block) const { return blocks_[block].count; }
  Vec3 at(std::size_t slot) const { return inSteps(stepsAt(slot)); }
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

  class BlockReader;  // of one block, below

 private:
  friend class CloudMaker;

  struct Block {
    std::array<std::int32_t, 3> low;
    std::array<std::uint16_t, 3> size;
    std::uint8_t count, spacing;  // spacing: a number of spacings_
    std::uint32_t begin;          // in packed_, in units
  };
  static constexpr std::uint64_t kUnit_bits = 32;
  static constexpr unsigned kMostOffsetBits = 3 * 16;  // of a point
  static_assert(kMostOffsetBits <= kWidestBits);

  /// The offsets of a block's slots: where they are, and what they are added to.
  struct Offsets {
    explicit Offsets(const Block& block);
    /// `bytes`: of all blocks.
    std::array<std::int32_t, 3> stepsAt(const std::uint8_t* bytes, std::size_t i) const;
    std::uint64_t bits() const { return kPerBlock * all; }
    std::uint64_t endBit() const { return first_bit + bits(); }

    std::array<std::int32_t, 3> low;
    std::array<unsigned, 3> width;  // bits along each axis
    unsigned all;                   // bits of a slot
    std::uint64_t first_bit;
  };

  static Vec3 inSteps(const std::array<std::int32_t, 3>& steps) {
    return {static_cast<double>(steps[0]), static_cast<double>(steps[1]), static_cast<double>(steps[2])};
  }

  CloudLattice lattice_;
  double error_m_ = 0, usual_spacing_ = 0;
  std::size_t size_ = 0;
  HugeVector<Block> blocks_;
  HugeVector<std::uint8_t> packed_;            // offsets and normals of all slots, and kReadBehind_bytes
  HugeVector<Rgb> colours_;                    // by slot, or none
  std::vector<HugeVector<LatticeBox>> nodes_;  // from the blocks up
  std::array<double, 256> spacings_{};         // m
};

/// The slots of one block, faster than by at() and normal(). Valid as long as the points are.
class CloudPoints::BlockReader {
 public:
  BlockReader(const CloudPoints& points, std::size_t block);
  Vec3 at(std::size_t i) const { return inSteps(offsets_.stepsAt(bytes_, i)); }
  std::uint32_t normal(std::size_t i) const { return normals_.read(bytes_, offsets_.endBit(), i); }

 private:
  const Offsets offsets_;
  const std::uint8_t* const bytes_;  // of all blocks
  const BlockNormals normals_;
};

// Inline, as each query reads many of them.

inline CloudPoints::Offsets::Offsets(const Block& block) : low(block.low), first_bit(kUnit_bits * block.begin) {
  for (std::size_t axis = 0; axis < 3; ++axis) width[axis] = static_cast<unsigned>(std::bit_width(block.size[axis]));
  all = width[0] + width[1] + width[2];
}

inline std::array<std::int32_t, 3> CloudPoints::Offsets::stepsAt(const std::uint8_t* bytes, std::size_t i) const {
  const std::uint64_t offsets = readBits(bytes, first_bit + i * all, all);
  const auto along = [&](std::size_t axis, unsigned before) {
    return low[axis] + static_cast<std::int32_t>(lowBits(offsets >> before, width[axis]));
  };
  return {along(0, 0), along(1, width[0]), along(2, width[0] + width[1])};
}

inline std::array<std::int32_t, 3> CloudPoints::stepsAt(std::size_t slot) const {
  return Offsets(blocks_[slot / kPerBlock]).stepsAt(packed_.data(), slot % kPerBlock);
}

inline std::uint32_t CloudPoints::normal(std::size_t slot) const {
  return BlockReader(*this, slot / kPerBlock).normal(slot % kPerBlock);
}

inline CloudPoints::BlockReader::BlockReader(const CloudPoints& points, std::size_t block)
    : offsets_(points.blocks_[block]), bytes_(points.packed_.data()), normals_(bytes_, offsets_.endBit()) {}

inline LatticeBox CloudPoints::box(int level, std::size_t number) const {
  if (level > 0) return nodes_[static_cast<std::size_t>(level) - 1][number];
  const Block& block = blocks_[number];
  return {block.low, {block.low[0] + block.size[0], block.low[1] + block.size[1], block.low[2] + block.size[2]}};
}

}  // namespace hl
