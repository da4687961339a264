#include "geometry/wide_bvh_pack.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/fixed_vector.h"

namespace hl {

namespace {

using Links = FixedVector<std::uint32_t, kWide>;

// Chooses the binary nodes that become wide nodes: those with the least total box area, as the probability that a query
// enters a box grows with its area. Dynamic programming from the blocks up (Ylitie et al. 2017): cost(link, m) is the
// minimum cost of a subtree represented by at most m children of a wide node above it.
class Collapse {
 public:
  explicit Collapse(const BinaryTree& tree) : tree_(tree), cost_(tree.nodes.size()) { fill(tree.root); }

  // The children of the wide node for `link`.
  Links childrenOf(std::uint32_t link) const {
    Links links;
    part(link, kWide, links);
    return links;
  }

 private:
  struct Shares {
    float cost;
    std::size_t left;  // number of the m children for the left side
  };

  float cost(std::uint32_t link, std::size_t m) const { return isBlock(link) ? 0 : cost_[link][m - 1]; }

  Shares shares(std::uint32_t link, std::size_t m) const {
    const auto& child = tree_.nodes[link].child;
    Shares best{std::numeric_limits<float>::infinity(), 1};
    for (std::size_t left = 1; left < m; ++left) {
      const float sum = cost(child[0], left) + cost(child[1], m - left);
      if (sum < best.cost) best = {sum, left};
    }
    return best;
  }

  void fill(std::uint32_t link) {
    if (isBlock(link)) return;
    for (const std::uint32_t child : tree_.nodes[link].child) fill(child);
    auto& costs = cost_[link];
    costs[0] = tree_.nodes[link].box.halfArea() + shares(link, kWide).cost;
    for (std::size_t m = 2; m < kWide; ++m) costs[m - 1] = std::min(costs[m - 2], shares(link, m).cost);
  }

  void part(std::uint32_t link, std::size_t m, Links& links) const {
    const Shares best = shares(link, m);
    const auto& child = tree_.nodes[link].child;
    place(child[0], best.left, links);
    place(child[1], m - best.left, links);
  }

  // Uses one child if that costs no more than several.
  void place(std::uint32_t link, std::size_t m, Links& links) const {
    while (m > 1 && cost(link, m) == cost(link, m - 1)) --m;
    if (m == 1) {
      links.push(link);
    } else {
      part(link, m, links);
    }
  }

  const BinaryTree& tree_;
  std::vector<std::array<float, kWide - 1>> cost_;
};

class Widener {
 public:
  Widener(const BinaryTree& tree, HugeVector<WideNode>& nodes) : collapse_(tree), nodes_(nodes) {}

  std::uint32_t add(std::uint32_t link, int depth) {
    if (isBlock(link)) return link;
    depth_ = std::max(depth_, depth + 1);
    const std::size_t self = nodes_.size();
    nodes_.push_back(WideNode{});
    const Links links = collapse_.childrenOf(link);
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      const bool used = lane < links.size();
      const std::uint32_t child = used ? add(links[lane], depth + 1) : kNoChild;
      nodes_[self].child[lane] = child;
    }
    return static_cast<std::uint32_t>(self);
  }

  int depth() const { return depth_; }

 private:
  Collapse collapse_;
  HugeVector<WideNode>& nodes_;
  int depth_ = 0;
};

// The step: the smallest power of two such that `largest`, divided by it, fits into 16 bits.
double stepFor(double largest) {
  int exponent = 0;
  std::frexp(largest / std::numeric_limits<std::int16_t>::max(), &exponent);
  return std::ldexp(1.0, exponent);
}

// A block during packing. Its lanes hold the numbers of their primitives.
class BlockPacker {
 public:
  BlockPacker(WideBlock& block, std::size_t count, const Primitives& primitives, const BlockScale& scale)
      : block_(block), count_(count), smallest_(scale.smallest) {
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      const auto corners = primitives.corners(block.primitive[lane < count ? lane : 0]);
      for (std::size_t i = 0; i < 3; ++i)
        at_.row(static_cast<Eigen::Index>(i * kWide + lane)) = (corners[i] - scale.origin).array();
    }
  }

  FloatBox box() const {
    Vec3 low, high;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      low[axis] = at_.col(axis).minCoeff();
      high[axis] = at_.col(axis).maxCoeff();
    }
    return roundedOutward(low, high);
  }

  void pack(const FloatBox& box) {
    const Eigen::Array4f origin = 0.5f * (box.min + box.max);
    const double half = static_cast<double>((box.max - origin).max(origin - box.min).head<3>().maxCoeff());
    const double per_step = 1 / stepFor(std::max(smallest_, half));
    block_.per_step = static_cast<float>(per_step);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      block_.origin[axis] = origin[axis];
      packAxis(axis, per_step);
    }
  }

 private:
  using Corners = Eigen::Array<double, 3 * kWide, 3>;

  void packAxis(Eigen::Index axis, double per_step) {
    // Adding this number leaves the nearest integer in the low bits.
    constexpr double kWholeInLastBits = 1.5 * (1LL << 52);
    const Eigen::Array<double, 3 * kWide, 1> steps =
        (at_.col(axis) - static_cast<double>(block_.origin[axis])) * per_step + kWholeInLastBits;
    for (std::size_t i = 0; i < 3; ++i) {
      std::int16_t* vertex = block_.vertex[i][axis];
      for (std::size_t lane = 0; lane < kWide; ++lane)
        vertex[lane] = static_cast<std::int16_t>(std::bit_cast<std::int64_t>(steps.data()[i * kWide + lane]));
      std::fill(vertex + count_, vertex + kWide, std::int16_t{0});
    }
  }

  WideBlock& block_;
  const std::size_t count_;
  const double smallest_;
  Corners at_;  // by vertex, then by lane; lanes without a primitive repeat the first
};

std::size_t primitivesOf(std::size_t block, std::size_t all) { return std::min(kWide, all - block * kWide); }

template <typename Make>
HugeVector<WideBlock> makeBlocks(std::size_t count, const Make& make) {
  constexpr std::size_t kBlocksOfATask = 512;
  HugeVector<WideBlock> blocks(count);
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, kBlocksOfATask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) make(i, blocks[i]);
  });
  return blocks;
}

}  // namespace

BoxedPrimitive boxed(const std::array<Vec3, 3>& corners, std::uint32_t number, const Vec3& origin) {
  const auto& v = corners;
  BoxedPrimitive result{
      roundedOutward(v[0].cwiseMin(v[1]).cwiseMin(v[2]) - origin, v[0].cwiseMax(v[1]).cwiseMax(v[2]) - origin)};
  result.setNumber(number);
  return result;
}

HugeVector<WideNode> widen(const BinaryTree& tree, int& depth) {
  constexpr std::size_t kChildren = 4;  // a node has more than these on average
  HugeVector<WideNode> nodes;
  nodes.reserve(tree.blocks.size() / kChildren);
  Widener widener(tree, nodes);
  widener.add(tree.root, 0);
  nodes.shrink_to_fit();
  depth = widener.depth();
  assert(depth <= static_cast<int>(kWideMostDepth));
  return nodes;
}

HugeVector<WideBlock> pack(const BinaryTree& tree, const Primitives& primitives, const BlockScale& scale) {
  return makeBlocks(tree.blocks.size(), [&](std::size_t i, WideBlock& block) {
    const std::size_t count = primitivesOf(i, primitives.size());
    for (std::size_t lane = 0; lane < kWide; ++lane)
      block.primitive[lane] = lane < count ? tree.primitives[i * kWide + lane].number() : 0;
    BlockPacker(block, count, primitives, scale).pack(tree.blocks[i]);
  });
}

HugeVector<WideBlock> repack(const HugeVector<WideBlock>& blocks, const Primitives& moved, const BlockScale& scale) {
  return makeBlocks(blocks.size(), [&](std::size_t i, WideBlock& block) {
    std::copy_n(blocks[i].primitive, kWide, block.primitive);
    BlockPacker packer(block, primitivesOf(i, moved.size()), moved, scale);
    packer.pack(packer.box());
  });
}

}  // namespace hl
