// The nearest primitive of a WideBvh: depth first, the nearest child first, and only what is within the nearest that is
// known. It is asked by batches, not by ticks, and one code for all processors is fast enough.
#include <algorithm>
#include <array>

#include "geometry/wide_bvh.h"
#include "geometry/wide_bvh_float_query.h"

namespace hl {

namespace {

struct Waiting {
  float distance2;  // m^2: a lower bound, but for rounding
  std::uint32_t link;
};

/// The squared distance of the point `from` to each box of the node.
void boxDistances2(const WideNode& node, const float (&from)[3], float (&distance2)[kWide]) {
  std::fill(std::begin(distance2), std::end(distance2), 0.0F);
  for (int axis = 0; axis < 3; ++axis) {
    float at = from[axis];
    if (node.turned != 0) {
      at = 0;
      for (int i = 0; i < 3; ++i) at += static_cast<float>(node.frame[i][axis]) / kFrameOne * from[i];
    }
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      const float apart = std::max({node.bound[0][axis][lane] - at, at - node.bound[1][axis][lane], 0.0F});
      distance2[lane] += apart * apart;
    }
  }
}

class NearestSearch {
 public:
  NearestSearch(const WideTree& tree, const Vec3& from, double farthest, FunctionRef<double(ElementId, double)> visit)
      : tree_(tree),
        from_{static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(from[2])},
        size_(tree.extent + from.cwiseAbs().maxCoeff()),
        visit_(visit) {
    setLimit(farthest);
  }

  std::size_t run() {
    std::size_t looked = 0;
    add({0, tree_.root});
    while (count_ > 0) {
      const Waiting next = waiting_[--count_];
      if (next.distance2 > reach2_) continue;
      looked += kWide;
      isBlock(next.link) ? look(next.link & ~kBlockLink) : enter(tree_.nodes[next.link]);
    }
    return looked;
  }

 private:
  // Single precision may place a box farther away than it is, by the margin of boxQuery().
  void setLimit(double limit) {
    limit_ = limit;
    const double reach = limit + kFramedRounding * (size_ + limit);
    reach2_ = static_cast<float>(reach * reach * (1 + kFramedRounding));
  }
  void add(const Waiting& one) { waiting_[count_++] = one; }

  // The children to come, the nearest on top.
  void enter(const WideNode& node) {
    float distance2[kWide];
    boxDistances2(node, from_, distance2);
    const std::size_t first = count_;
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      if (node.child[lane] == kNoChild || distance2[lane] > reach2_) continue;
      std::size_t place = count_++;
      for (; place > first && waiting_[place - 1].distance2 < distance2[lane]; --place)
        waiting_[place] = waiting_[place - 1];
      waiting_[place] = {distance2[lane], node.child[lane]};
    }
  }
  void look(std::uint32_t block) {
    const std::size_t used = std::min<std::size_t>(kWide, tree_.primitives - block * kWide);
    for (std::size_t lane = 0; lane < used; ++lane) {
      const double limit = visit_(tree_.blocks[block].primitive[lane], limit_);
      if (limit < limit_) setLimit(limit);
    }
  }

  const WideTree& tree_;
  const float from_[3];
  const double size_;  // m: of the coordinates, for their rounding
  FunctionRef<double(ElementId, double)> visit_;
  double limit_ = 0;
  float reach2_ = 0;
  std::size_t count_ = 0;
  std::array<Waiting, kWideStackSize> waiting_;
};

}  // namespace

std::size_t WideBvh::nearest(const Vec3& centre, double farthest, FunctionRef<double(ElementId, double)> visit) const {
  if (primitives_ == 0) return 0;
  const WideTree all = tree();
  return NearestSearch(all, centre - origin_, farthest, visit).run();
}

}  // namespace hl
