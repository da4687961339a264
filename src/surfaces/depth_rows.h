// The loops over all pixels of a depth image, compiled once for each instruction set; all give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "surfaces/samples.h"

namespace hl {

/// Depths of triangles, m. Empty if low > high: there are none.
struct DepthRange {
  float low, high;
  bool empty() const { return low > high; }
};

/// Depths of `count` samples from `first` on, in metres: `scale_m` times each of them. What is missing, not above 0, or
/// too large, becomes 0.
void readDepths(const Samples& samples, std::size_t first, std::size_t count, double scale_m, float* depths);

/// A piece of an image, and the same of the image before. Depths: above 0, or 0: none.
struct FollowedPixels {
  std::size_t count;
  const float *now, *before;
  const std::uint8_t* held_before;  ///< images since it was last seen
  float* depths;                    ///< the result; none of the inputs
  std::uint8_t* held;               ///< as held_before; may be the same
};
/// A pixel that is one surface with what it was (DepthCamera::joins) goes the part `share` of the way to what it is;
/// one that is missing stays for `most_held` images; else it is what it is.
struct FollowRule {
  float join, share;
  std::uint8_t most_held;
};
void followDepths(const FollowedPixels& pixels, const FollowRule& rule);

/// Rows of cells between rows of pixels.
struct CellBand {
  const float* first;  ///< pixel of the first row
  std::size_t pixels;  ///< in a row: one more than cells
  std::size_t rows;    ///< of cells
};
/// Bounds of the triangles that are joined, for each `side` cells of the band, at most kMaxSide. Returns the number of
/// triangles.
std::size_t boundCells(const CellBand& band, float join, std::size_t side, DepthRange* tiles);
inline constexpr std::size_t kMaxSide = 64;

}  // namespace hl
