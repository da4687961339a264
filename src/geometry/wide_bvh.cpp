#include "geometry/wide_bvh.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <limits>

#include "geometry/wide_bvh_boxes.h"
#include "geometry/wide_bvh_build.h"

namespace hl {

namespace {

using Range = oneapi::tbb::blocked_range<std::size_t>;
constexpr std::size_t kGrain = 4096;

double largest(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

void WideBvh::measure(const Primitives& primitives) {
  const Box bounds = primitives.bounds();
  origin_ = 0.5 * bounds.min + 0.5 * bounds.max;
  half_ = largest(bounds.max - origin_);
  extent_ = std::max(largest(bounds.min), largest(bounds.max));
}

// If all primitives are one point, nothing else defines the resolution of its position.
BlockScale WideBvh::scale() const {
  constexpr double kSmallest_m = 1e-12;
  constexpr double kSmallestPerExtent = 1.0 / (1LL << 40);
  return {origin_, std::max(kSmallest_m, kSmallestPerExtent * half_)};
}

WideBvh WideBvh::build(const Primitives& primitives) {
  static std::atomic<std::uint64_t> built{0};
  WideBvh bvh;
  bvh.tree_number_ = ++built;
  bvh.primitives_ = primitives.size();
  if (primitives.empty()) return bvh;
  assert(primitives.size() <= std::numeric_limits<std::uint32_t>::max());
  bvh.measure(primitives);
  std::vector<BoxedPrimitive> boxes(primitives.size());
  oneapi::tbb::parallel_for(Range(0, boxes.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      boxes[i] = boxed(primitives.corners(i), static_cast<std::uint32_t>(i), bvh.origin_);
  });
  const BinaryTree tree = buildBinaryTree(std::move(boxes));
  bvh.nodes_ = widen(tree, bvh.depth_);
  bvh.blocks_ = pack(tree, primitives, bvh.scale());
  orient(bvh.nodes_, bvh.blocks_);
  bvh.nodes_ = enclosed(bvh.nodes_, bvh.blocks_);
  bvh.cost_ = bvh.built_cost_ = costOf(bvh.nodes_);
  return bvh;
}

WideBvh WideBvh::refit(const Primitives& moved) const {
  assert(moved.size() == primitives_);
  WideBvh bvh;
  bvh.tree_number_ = tree_number_;
  bvh.primitives_ = primitives_;
  if (moved.empty()) return bvh;
  bvh.measure(moved);
  bvh.depth_ = depth_;
  bvh.blocks_ = repack(blocks_, moved, bvh.scale());
  bvh.nodes_ = enclosed(nodes_, bvh.blocks_);
  bvh.cost_ = costOf(bvh.nodes_);
  bvh.built_cost_ = built_cost_;
  return bvh;
}

WideTree WideBvh::tree() const {
  const std::uint32_t root = nodes_.empty() ? kBlockLink : 0;
  return {nodes_.data(), blocks_.data(), root, static_cast<std::uint32_t>(primitives_), half_};
}

double WideBvh::reach(const Vec3& from, const Vec3& motion, double radius) const {
  // Rounding of coordinate sums, a few units of 2^-53 times the largest coordinate.
  constexpr double kRounding = 1e-14;
  return radius + kRounding * (largest(from) + largest(motion) + extent_);
}

std::size_t WideBvh::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const auto visit_all = [&](ElementId primitive) {
    visit(primitive);
    return false;
  };
  return overlapUntil(centre, radius, visit_all);
}

std::size_t WideBvh::overlapUntil(const Vec3& centre, double radius, FunctionRef<bool(ElementId)> stop) const {
  if (primitives_ == 0) return 0;
  const Vec3 at = centre - origin_;
  return overlapWide(tree(), {{at[0], at[1], at[2]}, {0, 0, 0}, reach(centre, Vec3::Zero(), radius)}, stop);
}

std::size_t WideBvh::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                           FunctionRef<double(ElementId, double)> visit) const {
  constexpr double kMinPart = 1.0 / 8192;  // at most five more traversals then cover the whole way
  if (primitives_ == 0) return 0;
  const Vec3 at = from - origin_;
  const double length = motion.norm();
  const double first_part = soon < length ? std::max(kMinPart, soon / length) : 1;
  return sweepWide(tree(), {{at[0], at[1], at[2]}, {motion[0], motion[1], motion[2]}, reach(from, motion, radius)},
                   first_part, visit);
}

IndexStats WideBvh::stats() const {
  return IndexStats{nodes_.size(), blocks_.size(),
                    nodes_.capacity() * sizeof(WideNode) + blocks_.capacity() * sizeof(WideBlock), depth_};
}

}  // namespace hl
