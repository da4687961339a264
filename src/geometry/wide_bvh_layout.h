// What a WideBvh is made of: nodes of up to eight boxes and blocks of up to eight primitives, as arrays with one lane a
// box or primitive, so that one instruction looks at all of them. All coordinates are relative to the hierarchy's
// origin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hl {

inline constexpr std::size_t kWide = 8;

/// A link with this bit names a block, else a node.
inline constexpr std::uint32_t kBlockLink = 0x80000000u;
inline bool isBlock(std::uint32_t link) { return (link & kBlockLink) != 0; }
/// The link of an unused lane: the root is nobody's child.
inline constexpr std::uint32_t kNoChild = 0;

/// Boxes of up to eight children, rounded outward (metres), low in the tree in a frame that lies along the faces
/// beneath. There, a point x of the hierarchy is at frame / kFrameOne * x, and no two points are farther apart than
/// they were, so a distance in the frame is a lower bound of the true one. An unused lane has its smallest above its
/// largest coordinate, by an infinity, so no query enters it.
struct alignas(64) WideNode {
  float bound[2][3][kWide];  ///< smallest and largest coordinate by axis of the frame
  std::uint32_t child[kWide];
  std::int16_t frame[3][4];  ///< by axis of the hierarchy, of the frame; the fourth is 0
  std::uint32_t turned;      ///< 0: boxes lie along the hierarchy's axes, and there is no frame
};

inline constexpr float kFrameOne = 1 << 15;

/// Up to eight primitives; all blocks but the last are full. Coordinate = origin + vertex / per_step, at most half a
/// step off. A segment has vertex 2 == vertex 1, a point has all three equal.
struct alignas(64) WideBlock {
  std::int16_t vertex[3][3][kWide];  ///< by vertex and axis
  std::uint32_t primitive[kWide];
  float origin[3];
  float per_step;  ///< 1/m; a power of two, so that scaling by it rounds nothing
};

static_assert(sizeof(WideNode) == 256 && sizeof(WideBlock) == 192);

/// Depth allowed per lg of the number of blocks: below it the cheapest split may be as uneven as it likes, then halving
/// takes over, so the traversal's stack and the work of the build are bounded for every input.
inline constexpr double kWideDepthPerLg = 2.5;
/// 2.5 * 29, the most for primitives numbered by 32 bits. A walk keeps at most seven waiting children for each level.
inline constexpr std::size_t kWideMostDepth = 72;
inline constexpr std::size_t kWideStackSize = 7 * kWideMostDepth + 8;

struct WideTree {
  const WideNode* nodes;
  const WideBlock* blocks;
  std::uint32_t root;        ///< a link
  std::uint32_t primitives;  ///< at least one; number k is in block k / 8
  double extent;             ///< m: largest coordinate of its boxes
};

/// Relative to the hierarchy's origin, metres. `reach` is the radius with all that double arithmetic may be off by.
struct WideQuery {
  double from[3];
  double motion[3];
  double reach;
};

}  // namespace hl
