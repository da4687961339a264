#include "geometry/moving_bvh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hl {

namespace {

// The moving sphere, relative to the origin of the first hierarchy.
struct MovingWay {
  Vec3 from, motion;
  double reach;
  double limit = 1;  // fraction of the motion that still has to be searched
};

// The two hierarchies as one tree, over a range of the transition.
class Pair {
 public:
  Pair(const WideBvh& from, const WideBvh& to, double begin, double end)
      : from_(from), to_(to), begin_(begin), end_(end), shift_(to.origin() - from.origin()) {}

  MovingWay way(const Vec3& from, const Vec3& motion, double radius) const {
    // Rounding of sums of coordinates, a few units of 2^-53 times the largest; twice as many sums as in WideBvh.
    constexpr double kRounding = 2e-14;
    const auto largest = [](const Vec3& v) { return v.cwiseAbs().maxCoeff(); };
    const double sizes = largest(from) + largest(motion) + from_.extent() + to_.extent();
    return {from - from_.origin(), motion, radius + kRounding * sizes};
  }

  // Calls visit(primitive) for each primitive whose box the sphere may enter up to way.limit, which visit() may reduce.
  // Returns the number of boxes visited.
  template <typename Visit>
  std::size_t walk(const MovingWay& way, const Visit& visit) const {
    if (from_.primitives() == 0) return 0;
    std::array<std::uint32_t, kWideStackSize> waiting;
    std::size_t count = 0, looked = 0;
    waiting[count++] = from_.nodes().empty() ? kBlockLink : 0;
    while (count > 0) {
      const std::uint32_t link = waiting[--count];
      looked += kWide;
      if ((link & kBlockLink) != 0) {
        lookInto(link & ~kBlockLink, way, visit);
        continue;
      }
      const WideNode &a = from_.nodes()[link], &b = to_.nodes()[link];
      const Frame frame = frameOf(a, way);
      for (std::size_t lane = 0; lane < kWide; ++lane) {
        if (a.child[lane] != kNoChild && meets(a, b, lane, frame, way.reach)) waiting[count++] = a.child[lane];
      }
    }
    return looked;
  }

 private:
  // The bounds of the way in the frame of a node, and the offset of the origins in that frame.
  struct Frame {
    Vec3 low, high, shift;
  };

  static Vec3 turned(const WideNode& node, const Vec3& v) {
    if (node.turned == 0) return v;
    Vec3 result = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t to = 0; to < 3; ++to)
        result[static_cast<Eigen::Index>(to)] += node.frame[axis][to] * v[static_cast<Eigen::Index>(axis)];
    }
    return result / static_cast<double>(kFrameOne);
  }

  Frame frameOf(const WideNode& node, const MovingWay& way) const {
    const Vec3 begin = turned(node, way.from), end = turned(node, way.from + way.limit * way.motion);
    return {begin.cwiseMin(end), begin.cwiseMax(end), turned(node, shift_)};
  }

  double between(double a, double b, double part) const { return (1 - part) * a + part * b; }

  // Squared distance along one axis between the way and an interval that moves from low_a..high_a to low_b..high_b.
  double apart2(double low_a, double high_a, double low_b, double high_b, double way_low, double way_high) const {
    const double low = std::min(between(low_a, low_b, begin_), between(low_a, low_b, end_));
    const double high = std::max(between(high_a, high_b, begin_), between(high_a, high_b, end_));
    const double apart = std::max({low - way_high, way_low - high, 0.0});
    return apart * apart;
  }

  bool meets(const WideNode& a, const WideNode& b, std::size_t lane, const Frame& frame, double reach) const {
    double sum2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      sum2 += apart2(a.bound[0][axis][lane], a.bound[1][axis][lane], b.bound[0][axis][lane] + frame.shift[i],
                     b.bound[1][axis][lane] + frame.shift[i], frame.low[i], frame.high[i]);
    }
    return sum2 <= reach * reach;
  }

  // Bounds of a primitive along one axis, with a margin for the quantisation.
  static std::array<double, 2> extentOf(const WideBlock& block, std::size_t axis, std::size_t lane) {
    const auto [least, most] =
        std::minmax({block.vertex[0][axis][lane], block.vertex[1][axis][lane], block.vertex[2][axis][lane]});
    const double step = 1 / static_cast<double>(block.per_step), origin = static_cast<double>(block.origin[axis]);
    return {origin + step * (least - 0.5), origin + step * (most + 0.5)};
  }

  template <typename Visit>
  void lookInto(std::uint32_t number, const MovingWay& way, const Visit& visit) const {
    const WideBlock &a = from_.blocks()[number], &b = to_.blocks()[number];
    const std::size_t left = from_.primitives() - std::size_t{number} * kWide;
    for (std::size_t lane = 0; lane < std::min(kWide, left); ++lane) {
      const Vec3 end = way.from + way.limit * way.motion;
      double sum2 = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        const auto at_a = extentOf(a, axis, lane), at_b = extentOf(b, axis, lane);
        sum2 += apart2(at_a[0], at_a[1], at_b[0] + shift_[i], at_b[1] + shift_[i], std::min(way.from[i], end[i]),
                       std::max(way.from[i], end[i]));
      }
      if (sum2 <= way.reach * way.reach) visit(a.primitive[lane]);
    }
  }

  const WideBvh& from_;
  const WideBvh& to_;
  const double begin_, end_;
  const Vec3 shift_;
};

}  // namespace

std::size_t MovingBvh::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const Pair pair(from_, to_, begin_, end_);
  return pair.walk(pair.way(centre, Vec3::Zero(), radius), visit);
}

// Searches a first part of the way, and larger parts only if nothing is hit: goals are far away, and most ways end
// soon.
std::size_t MovingBvh::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                             FunctionRef<double(ElementId, double)> visit) const {
  constexpr double kMinPart = 1.0 / 8192, kLarger = 8;
  const Pair pair(from_, to_, begin_, end_);
  MovingWay way = pair.way(from, motion, radius);
  const double length = motion.norm();
  std::size_t looked = 0;
  for (double part = soon < length ? std::max(kMinPart, soon / length) : 1;; part = std::min(1.0, kLarger * part)) {
    way.limit = part;
    looked +=
        pair.walk(way, [&](ElementId primitive) { way.limit = std::min(way.limit, visit(primitive, way.limit)); });
    if (way.limit < part || part >= 1) return looked;
  }
}

}  // namespace hl
