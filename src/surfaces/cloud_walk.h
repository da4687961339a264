// CloudWalk: from the top of a cloud's nodes to the points that a moving ball may touch, those near its begin first.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "surfaces/ball_boxes.h"
#include "surfaces/point_cloud.h"

namespace hl {

class CloudWalk {
 public:
  /// `scale`: shortestStep() of the cloud's frame.
  CloudWalk(const PointCloud& cloud, const Vec3& scale, const GridBall& ball)
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
    const std::size_t first = block * CloudPoints::kPerBlock;
    for (std::size_t slot = first; slot < first + points_.countIn(block); ++slot) {
      ++looked_;
      if (!boxes_.isNear(points_.at(slot), reach)) continue;
      for (std::size_t i = 0; i < cloud_.perPoint(); ++i) visit(static_cast<ElementId>(slot * cloud_.perPoint() + i));
    }
  }

  const PointCloud& cloud_;
  const CloudPoints& points_;
  const GridBall& ball_;
  const BallBoxes boxes_;
  const Vec3 out_;  // grid steps
  std::size_t looked_ = 0;
};

}  // namespace hl
