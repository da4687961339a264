// CloudWalk: from the top of a cloud's nodes to the points that a moving ball may touch, those near its begin first.
//
// A surfel lies in a disc of radius R in the plane of its normal. The ball, of radius r, meets the plane while its
// centre is at a height of at most r over it, and the disc only if then, in the plane, the centre comes within
//   R + sqrt(r^2 - h^2)
// of the middle, h the least height on that part of the way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "surfaces/ball_boxes.h"
#include "surfaces/placed_cloud.h"

namespace hl {

class CloudWalk {
 public:
  /// `scale`: shortestStep() of the cloud's frame.
  CloudWalk(const PlacedCloud& cloud, const Vec3& scale, const GridBall& ball)
      : cloud_(cloud),
        points_(*cloud.points()),
        ball_(ball),
        boxes_(ball, scale),
        out_(cloud.largestReach() * ball.metric().reach) {}

  /// Calls visit(id) for each primitive that the ball may touch. Returns the number of boxes and points visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    enter(points_.levels() - 1, 0, visit);
    return looked_;
  }

 private:
  struct Part {
    std::size_t number;
    Vec3 middle, half;
    double order;
  };

  bool meets(const Part& part) {
    ++looked_;
    return boxes_.meets(part.middle, part.half);
  }

  // Grid coordinates, with what surfels reach beyond their points.
  Part partOf(int level, std::size_t number) const {
    const LatticeBox box = points_.box(level, number);
    const Vec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
    Part part{number, 0.5 * (low + high), 0.5 * (high - low) + out_, 0};
    const Vec3 from = part.middle - ball_.first(), way = ball_.last() - ball_.first();
    part.order = way.isZero(0) ? from.squaredNorm() : from.dot(way);
    return part;
  }

  template <typename Visit>
  void enter(int level, std::size_t number, const Visit& visit) {
    if (level == 0) return look(number, visit);
    std::array<Part, CloudPoints::kPerNode> parts;
    std::size_t count = 0;
    const std::size_t first = number * CloudPoints::kPerNode;
    const std::size_t end = std::min(first + CloudPoints::kPerNode, points_.countOn(level - 1));
    for (std::size_t i = first; i < end; ++i) {
      parts[count] = partOf(level - 1, i);
      if (!meets(parts[count])) continue;
      std::size_t place = count++;
      for (; place > 0 && parts[place - 1].order > parts[place].order; --place)
        std::swap(parts[place - 1], parts[place]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (i == 0 || boxes_.meets(parts[i].middle, parts[i].half)) enter(level - 1, parts[i].number, visit);
    }
  }

  template <typename Visit>
  void look(std::size_t block, const Visit& visit) {
    const double reach = cloud_.reachOf(block);
    const CloudPoints::BlockReader reader(points_, block);
    for (std::size_t n = 0; n < points_.countIn(block); ++n) {
      ++looked_;
      const Vec3 at = reader.at(n);
      if (!boxes_.isNear(at, reach)) continue;
      if (cloud_.surfels() && !meetsDisc(at, cloud_.normalOf(reader.normal(n)), reach)) continue;
      const std::size_t slot = block * CloudPoints::kPerBlock + n;
      for (std::size_t i = 0; i < cloud_.perPoint(); ++i) visit(static_cast<ElementId>(slot * cloud_.perPoint() + i));
    }
  }

  // Metres, from the middle of the surfel. `at`: grid coordinates.
  bool meetsDisc(const Vec3& at, const Vec3& normal, double reach) const {
    const Mat3& axes = cloud_.frame().axes;
    const Vec3 from = axes * (ball_.first() - at);
    const Vec3 way = axes * (ball_.last() - ball_.first());
    const double rounding = kRounding * (from.norm() + way.norm() + reach) + 2 * cloud_.rounding();
    const double radius = (1 + kRounding) * ball_.radius() + rounding;
    const double height = normal.dot(from), rise = normal.dot(way);
    double begin = 0, end = 1;
    if (std::abs(rise) > rounding) {
      const double one = (-radius - height) / rise, other = (radius - height) / rise;
      begin = std::max(0.0, std::min(one, other) - kRounding);
      end = std::min(1.0, std::max(one, other) + kRounding);
    } else if (std::abs(height) > radius + rounding) {
      return false;
    }
    if (begin > end) return false;
    const double first = height + begin * rise, last = height + end * rise;
    const bool through = (first < 0) != (last < 0);
    const double low = through ? 0 : std::max(0.0, std::min(std::abs(first), std::abs(last)) - rounding);
    const double across = reach + rounding + std::sqrt(std::max(0.0, radius * radius - low * low));
    const Vec3 flat = from - height * normal, along = way - rise * normal;
    const double square = along.squaredNorm();
    const double part = square > 0 ? std::clamp(-flat.dot(along) / square, begin, end) : begin;
    return (flat + part * along).squaredNorm() <= across * across;
  }

  static constexpr double kRounding = 1e-9;  // of sizes, and of a way

  const PlacedCloud& cloud_;
  const CloudPoints& points_;
  const GridBall& ball_;
  const BallBoxes boxes_;
  const Vec3 out_;  // grid steps
  std::size_t looked_ = 0;
};

}  // namespace hl
