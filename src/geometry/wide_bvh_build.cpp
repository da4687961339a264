#include "geometry/wide_bvh_build.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hl {

namespace {

using Array4f = Eigen::Array4f;

constexpr std::size_t kBins = 16;
constexpr std::size_t kParallelBlocks = 512;  // below this a task costs more than it saves

int levelsByHalving(std::size_t blocks) { return blocks < 2 ? 0 : static_cast<int>(std::bit_width(blocks - 1)); }

std::size_t blocksFor(std::size_t primitives) { return (primitives + kWide - 1) / kWide; }

// Twice the centre: the same order with less rounding.
Array4f middle(const FloatBox& box) { return box.min + box.max; }

struct Extent {
  FloatBox box, middles;
};

// Assigns bins to the centres along the three axes. An axis on which they hardly differ has one bin.
class Binning {
 public:
  explicit Binning(const FloatBox& middles) : low_(middles.min) {
    constexpr float kBelowEnd = 0.9999f;
    constexpr float kSmallest = 1e-30f;
    const Array4f size = middles.max - middles.min;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (size[axis] > kSmallest) scale_[axis] = kBelowEnd * static_cast<float>(kBins) / size[axis];
    }
  }
  bool splits(std::size_t axis) const { return scale_[static_cast<Eigen::Index>(axis)] > 0; }
  std::array<std::int32_t, 4> operator()(const FloatBox& box) const {
    const Eigen::Array4i bins = ((middle(box) - low_) * scale_).cast<std::int32_t>();
    return {bins[0], bins[1], bins[2], 0};
  }
  std::int32_t on(std::size_t axis, const FloatBox& box) const {
    const auto i = static_cast<Eigen::Index>(axis);
    return static_cast<std::int32_t>((box.min[i] + box.max[i] - low_[i]) * scale_[i]);
  }

 private:
  Array4f low_;
  Array4f scale_ = Array4f::Zero();
};

struct Bin {
  FloatBox box;
  std::size_t count = 0;
  void add(const Bin& other) {
    box.extend(other.box);
    count += other.count;
  }
};
using Bins = std::array<Bin, kBins>;

// The split: before a bin of an axis. There is no best axis if all primitives are in one bin.
struct Cut {
  float cost = std::numeric_limits<float>::infinity();
  std::size_t axis = 3;
  std::size_t bin = 0;
};

// Cost of a child: its area times its number of blocks, as a block costs the same whether it is full or not.
float costOf(const Bin& child) { return child.box.halfArea() * static_cast<float>(blocksFor(child.count)); }

void improve(const Bins& bins, std::size_t axis, Cut& best) {
  std::array<float, kBins> right_cost{};
  Bin right;
  for (std::size_t i = kBins - 1; i > 0; --i) {
    right.add(bins[i]);
    right_cost[i] = right.count == 0 ? std::numeric_limits<float>::infinity() : costOf(right);
  }
  Bin left;
  for (std::size_t i = 1; i < kBins; ++i) {
    left.add(bins[i - 1]);
    if (left.count == 0) continue;
    const float cost = costOf(left) + right_cost[i];
    if (cost < best.cost) best = {cost, axis, i};
  }
}

class BinaryTreeBuilder {
 public:
  explicit BinaryTreeBuilder(BinaryTree& tree) : tree_(tree) {
    const double lg = std::log2(static_cast<double>(tree.blocks.size()));
    depth_allowed_ = std::max(levelsByHalving(tree.blocks.size()), static_cast<int>(kWideDepthPerLg * lg));
  }

  // Builds the tree over blocks [begin, end) and returns its link.
  std::uint32_t build(std::size_t begin, std::size_t end, int depth) {
    const Run run = runOf(begin, end);
    const Extent extent = measure(run);
    if (end - begin == 1) {
      tree_.blocks[begin] = extent.box;
      return kBlockLink | static_cast<std::uint32_t>(begin);
    }
    const std::size_t cut = begin + split(run, extent.middles, depth);
    BinaryNode& node = tree_.nodes[cut];
    node.box = extent.box;
    const auto left = [&] { node.child[0] = build(begin, cut, depth + 1); };
    const auto right = [&] { node.child[1] = build(cut, end, depth + 1); };
    if (end - begin >= kParallelBlocks) {
      oneapi::tbb::parallel_invoke(left, right);
    } else {
      left();
      right();
    }
    return static_cast<std::uint32_t>(cut);
  }

 private:
  using Run = std::span<BoxedPrimitive>;

  Run runOf(std::size_t begin, std::size_t end) {
    const std::size_t last = std::min(end * kWide, tree_.primitives.size());
    return Run(tree_.primitives).subspan(begin * kWide, last - begin * kWide);
  }

  static Extent measure(Run run) {
    Extent extent;
    for (const BoxedPrimitive& primitive : run) {
      extent.box.extend(primitive.box);
      const Array4f at = middle(primitive.box);
      extent.middles.min = extent.middles.min.min(at);
      extent.middles.max = extent.middles.max.max(at);
    }
    return extent;
  }

  // Orders the run so that the primitives of the left child come first; returns their number of blocks.
  std::size_t split(Run run, const FloatBox& middles, int depth) const {
    const std::size_t blocks = blocksFor(run.size());
    const Binning binning(middles);
    const Cut cut = cheapest(run, binning);
    if (cut.axis < 3) {
      const auto first_right = std::partition(run.begin(), run.end(), [&](const BoxedPrimitive& primitive) {
        return binning.on(cut.axis, primitive.box) < static_cast<std::int32_t>(cut.bin);
      });
      const auto count = static_cast<std::size_t>(first_right - run.begin());
      const std::size_t left = std::clamp<std::size_t>((count + kWide / 2) / kWide, 1, blocks - 1);
      if (depth + 1 + levelsByHalving(std::max(left, blocks - left)) <= depth_allowed_) {
        moveBoundary(run, count, left * kWide, cut.axis);
        return left;
      }
    }
    return halve(run, middles, blocks / 2);
  }

  static Cut cheapest(Run run, const Binning& binning) {
    std::array<Bins, 3> bins;
    for (const BoxedPrimitive& primitive : run) {
      const auto number = binning(primitive.box);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][static_cast<std::size_t>(number[axis])];
        bin.box.extend(primitive.box);
        ++bin.count;
      }
    }
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (binning.splits(axis)) improve(bins[axis], axis, best);
    }
    return best;
  }

  // Moves the split of a run from `from` to `to` along the axis, so that the blocks of the left child are full. The few
  // primitives between are those of the larger side that are nearest to the other side.
  static void moveBoundary(Run run, std::size_t from, std::size_t to, std::size_t axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const auto at = [&](const BoxedPrimitive& p) { return p.box.min[i] + p.box.max[i]; };
    for (; from > to; --from) {
      const auto last = run.begin() + static_cast<std::ptrdiff_t>(from);
      std::iter_swap(std::max_element(run.begin(), last, [&](const auto& a, const auto& b) { return at(a) < at(b); }),
                     last - 1);
    }
    for (; from < to; ++from) {
      const auto first = run.begin() + static_cast<std::ptrdiff_t>(from);
      std::iter_swap(std::min_element(first, run.end(), [&](const auto& a, const auto& b) { return at(a) < at(b); }),
                     first);
    }
  }

  static std::size_t halve(Run run, const FloatBox& middles, std::size_t left) {
    Eigen::Index axis = 0;
    (middles.max - middles.min).head<3>().maxCoeff(&axis);
    const auto median = run.begin() + static_cast<std::ptrdiff_t>(left * kWide);
    std::nth_element(run.begin(), median, run.end(), [axis](const BoxedPrimitive& a, const BoxedPrimitive& b) {
      return a.box.min[axis] + a.box.max[axis] < b.box.min[axis] + b.box.max[axis];
    });
    return left;
  }

  BinaryTree& tree_;
  int depth_allowed_ = 0;
};

}  // namespace

BinaryTree buildBinaryTree(std::vector<BoxedPrimitive> primitives) {
  BinaryTree tree;
  tree.primitives = std::move(primitives);
  const std::size_t blocks = blocksFor(tree.primitives.size());
  tree.blocks.resize(blocks);
  tree.nodes.resize(blocks);
  tree.root = BinaryTreeBuilder(tree).build(0, blocks, 0);
  return tree;
}

}  // namespace hl
