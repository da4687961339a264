#include "bodies/contact_hull.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hl {

namespace {

// Sine of the angle by which a corner has to lie to either side of the line to another one.
constexpr double kBeside = 0.05;
// Of a triangle: what lies outside of its sides by no more counts as within.
constexpr double kOutside = 1e-6;
constexpr double kHalf = 0.70710678;  // sine of 45 degrees

double cross(const Eigen::Vector2d& x, const Eigen::Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); }

}  // namespace

ContactHull::ContactHull(std::span<const FlatContact> contacts) {
  const std::array<Eigen::Vector2d, 8> directions{
      {{1, 0}, {kHalf, kHalf}, {0, 1}, {-kHalf, kHalf}, {-1, 0}, {-kHalf, -kHalf}, {0, -1}, {kHalf, -kHalf}}};
  FixedVector<std::size_t, 8> numbers;
  for (const Eigen::Vector2d& direction : directions) {
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i) {
      if (direction.dot(contacts[i].at) > direction.dot(contacts[farthest].at)) farthest = i;
    }
    if (contacts.empty() || std::find(numbers.begin(), numbers.end(), farthest) != numbers.end()) continue;
    numbers.push(farthest);
    corners_.push(contacts[farthest]);
  }
}

// Turned about the place, the side of a half plane that holds no corner meets one of them first.
bool ContactHull::surround(const Eigen::Vector2d& at) const {
  for (const FlatContact& one : corners_) {
    const Eigen::Vector2d line = one.at - at;
    bool left = false, right = false;
    for (const FlatContact& other : corners_) {
      const Eigen::Vector2d way = other.at - at;
      const double beside = cross(line, way), least = kBeside * line.norm() * way.norm();
      left |= beside > least;
      right |= beside < -least;
    }
    if (!left || !right) return false;
  }
  return !corners_.empty();
}

// Each gap between the corners is that of a triangle of them: the lowest of these counts.
bool ContactHull::keeps(const FlatContact& one, double slack_m) const {
  if (!surround(one.at)) return false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (std::size_t j = i + 1; j < corners_.size(); ++j) {
      for (std::size_t k = j + 1; k < corners_.size(); ++k) {
        const Eigen::Vector2d a = corners_[i].at - one.at, b = corners_[j].at - one.at, c = corners_[k].at - one.at;
        const Vec3 parts(cross(b, c), cross(c, a), cross(a, b));
        const double area = parts.sum();
        if (!(area != 0) || (parts / area).minCoeff() < -kOutside) continue;
        const double gap = parts.dot(Vec3(corners_[i].gap, corners_[j].gap, corners_[k].gap)) / area;
        if (gap <= one.gap + slack_m) return true;
      }
    }
  }
  return false;
}

}  // namespace hl
