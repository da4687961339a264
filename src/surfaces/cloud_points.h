// CloudPoints: the points of a cloud on a lattice, in blocks of neighbours with their bounds: 7.5 bytes a point, and
// four more for normals, three for colours if there are any. A laser scanner's file is such a lattice, so nothing is
// rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/huge_pages.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "surfaces/packed_normal.h"

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
  std::uint32_t normal(std::size_t slot) const { return normals_[slot]; }
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

 private:
  friend class CloudMaker;

  struct Block {
    std::array<std::int32_t, 3> low;
    std::array<std::uint16_t, 3> size;
    std::uint8_t count, spacing;  // spacing: a number of spacings_
  };

  CloudLattice lattice_;
  double error_m_ = 0, usual_spacing_ = 0;
  std::size_t size_ = 0;
  HugeVector<Block> blocks_;
  HugeVector<std::array<std::uint16_t, 3>> offsets_;  // from the block's low, by slot
  HugeVector<std::uint32_t> normals_;                 // by slot
  HugeVector<Rgb> colours_;                           // by slot, or none
  std::vector<HugeVector<LatticeBox>> nodes_;         // from the blocks up
  std::array<double, 256> spacings_{};                // m
};

// Inline, as each query reads many of them.

inline std::array<std::int32_t, 3> CloudPoints::stepsAt(std::size_t slot) const {
  const Block& block = blocks_[slot / kPerBlock];
  const std::array<std::uint16_t, 3>& offset = offsets_[slot];
  return {block.low[0] + offset[0], block.low[1] + offset[1], block.low[2] + offset[2]};
}

inline Vec3 CloudPoints::at(std::size_t slot) const {
  const std::array<std::int32_t, 3> steps = stepsAt(slot);
  return {static_cast<double>(steps[0]), static_cast<double>(steps[1]), static_cast<double>(steps[2])};
}

inline LatticeBox CloudPoints::box(int level, std::size_t number) const {
  if (level > 0) return nodes_[static_cast<std::size_t>(level) - 1][number];
  const Block& block = blocks_[number];
  return {block.low, {block.low[0] + block.size[0], block.low[1] + block.size[1], block.low[2] + block.size[2]}};
}

}  // namespace hl
