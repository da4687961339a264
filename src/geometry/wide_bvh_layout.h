// Memory layout of a WideBvh: nodes of up to eight boxes and blocks of up to eight primitives, as arrays with one lane
// per box or primitive, so that one instruction tests all of them. All coordinates are relative to the hierarchy's
// origin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hl {

inline constexpr std::size_t kWide = 8;

/// A link with this bit is to a block, else to a node.
inline constexpr std::uint32_t kBlockLink = 0x80000000u;
inline bool isBlock(std::uint32_t link) { return (link & kBlockLink) != 0; }
/// The link of an unused lane: the root is never a child.
inline constexpr std::uint32_t kNoChild = 0;

/// Boxes of up to eight children, rounded outward (m). Low in the tree they are in a frame aligned with the faces
/// below. A point x of the hierarchy is at frame / kFrameOne * x in the frame. The transformation never increases a
/// distance, so a distance in the frame is a lower bound of the true one. In an unused lane the lower bound is
/// +infinity and the upper bound -infinity, so no query enters it.
struct alignas(64) WideNode {
  float bound[2][3][kWide];  ///< lower and upper bound, by axis of the frame
  std::uint32_t child[kWide];
  std::int16_t frame[3][4];  ///< by axis of the hierarchy, then of the frame; the fourth is 0
  std::uint32_t turned;      ///< 0: boxes are aligned with the hierarchy's axes, and there is no frame
};

inline constexpr float kFrameOne = 1 << 15;

/// Up to eight primitives; all blocks but the last are full. Coordinate = origin + vertex / per_step, with an error of
/// at most half a step. A segment has vertex 2 == vertex 1, a point has all three equal.
struct alignas(64) WideBlock {
  std::int16_t vertex[3][3][kWide];  ///< by vertex and axis
  std::uint32_t primitive[kWide];
  float origin[3];
  float per_step;  ///< 1/m; a power of two, so that scaling by it is exact
};

static_assert(sizeof(WideNode) == 256 && sizeof(WideBlock) == 192);

/// Maximum depth per lg of the number of blocks. Within it the cheapest split may be of any ratio; after that the runs
/// are halved. So the stack of the traversal and the cost of the build are bounded for every input.
inline constexpr double kWideDepthPerLg = 2.5;
/// 2.5 * 29, the maximum for primitives numbered by 32 bits. A traversal keeps at most seven waiting children per
/// level.
inline constexpr std::size_t kWideMostDepth = 72;
inline constexpr std::size_t kWideStackSize = 7 * kWideMostDepth + 8;

struct WideTree {
  const WideNode* nodes;
  const WideBlock* blocks;
  std::uint32_t root;        ///< a link
  std::uint32_t primitives;  ///< at least one; primitive k is in block k / 8
  double extent;             ///< m: largest absolute coordinate of its boxes
};

/// Relative to the hierarchy's origin, m. `reach`: the radius with a margin for the rounding of double precision.
struct WideQuery {
  double from[3];
  double motion[3];
  double reach;
};

}  // namespace hl
