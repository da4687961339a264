// EqualBoxes: which of many boxes of one size, along the axes of a grid, a moving ball may meet, and when.
//
// As BallBoxes decides it: by the bounds of the ball, whose centre moves along a segment; and by its distance from the
// middle of a box, along axes with a scale that makes nothing longer. What all boxes have in common is computed once.
#pragma once

#include <algorithm>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

/// Of the part of the ball's way that counts when this is made.
class EqualBoxes {
 public:
  /// `scale`: shortestStep() of the grid's frame. Grid coordinates; `half`: half the sides of the boxes.
  EqualBoxes(const GridBall& ball, const Vec3& scale, const Vec3& half)
      : scale_(scale),
        first_(ball.first()),
        way_(ball.last() - ball.first()),
        across_(0.5 * (ball.high() - ball.low() - way_.cwiseAbs()) + half),
        along_(scale.cwiseProduct(way_)),
        diagonal_(half.cwiseProduct(scale).norm()),
        begin_(ball.begin()),
        length_(ball.end() - ball.begin()) {
    const double reach = (1 + kRounding) * (ball.radius() + diagonal_), square = along_.squaredNorm();
    square_ = reach * reach;
    moves_ = square > 0;
    per_square_ = moves_ ? 1 / square : 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) per_way_[axis] = way_[axis] == 0 ? 0 : 1 / way_[axis];
  }

  bool moves() const { return moves_; }
  /// Whether the ball may meet the box about `middle`. Then `order` is a bound of when: a fraction of the motion; of a
  /// ball that does not move, of the distance from its centre, m.
  bool meets(const Vec3& middle, double& order) const {
    const Vec3 to = middle - first_;
    double begin = 0, end = 1;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (per_way_[axis] == 0) {
        if (std::abs(to[axis]) > across_[axis]) return false;
        continue;
      }
      const double at = to[axis] * per_way_[axis], half = across_[axis] * std::abs(per_way_[axis]);
      const double rounding = kRounding + kDivided * std::abs(at);
      begin = std::max(begin, at - half - rounding);
      end = std::min(end, at + half + rounding);
    }
    return begin <= end && isNear(scale_.cwiseProduct(to), begin, end, order);
  }

 private:
  static constexpr double kRounding = 1e-9;  // of sizes, and of a way
  static constexpr double kDivided = 1e-15;  // of a quotient

  // The centre is within reach of the middle on a chord of its line.
  bool isNear(const Vec3& to, double begin, double end, double& order) const {
    const double nearest = moves_ ? to.dot(along_) * per_square_ : 0;
    const double left = square_ - (to - nearest * along_).squaredNorm();
    if (left < 0) return false;
    if (!moves_) {
      order = to.norm() - diagonal_;
      return true;
    }
    const double chord = std::sqrt(left * per_square_), rounding = kRounding + kDivided * std::abs(nearest);
    begin = std::max(begin, nearest - chord - rounding);
    if (begin > std::min(end, nearest + chord + rounding)) return false;
    order = begin_ + begin * length_;
    return true;
  }

  const Vec3& scale_;
  const Vec3 first_, way_, across_, along_;
  Vec3 per_way_;
  const double diagonal_, begin_, length_;
  double square_, per_square_;
  bool moves_;
};

}  // namespace hl
