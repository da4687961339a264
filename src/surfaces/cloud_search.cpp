#include "surfaces/cloud_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace hl {

void NearestPoints::add(const Vec3& at, double square) {
  if (!takes(square)) return;
  std::size_t place = size_ < kMost ? size_++ : kMost - 1;
  for (; place > 0 && square_[place - 1] > square; --place) {
    square_[place] = square_[place - 1];
    at_[place] = at_[place - 1];
  }
  square_[place] = square;
  at_[place] = at;
}

// n points are in a disc of their farthest: pi d^2 = n s^2.
double NearestPoints::spacing() const { return std::sqrt(farthest() * M_PI / static_cast<double>(size_)); }

Vec3 NearestPoints::normal() const {
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < size_; ++i) middle += at_[i];
  middle /= static_cast<double>(size_);
  Mat3 spread = Mat3::Zero();
  for (std::size_t i = 0; i < size_; ++i) spread += (at_[i] - middle) * (at_[i] - middle).transpose();
  const double size = spread.trace();
  if (!(size > 0)) return Vec3::UnitY();
  return Eigen::SelfAdjointEigenSolver<Mat3>(spread / size).eigenvectors().col(0);
}

double CloudSearch::squareTo(const LatticeBox& box, const Vec3& place) const {
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double out = std::max({step_[a] * box.low[axis] - place[a], place[a] - step_[a] * box.high[axis], 0.0});
    square += out * out;
  }
  return square;
}

void CloudSearch::look(int level, std::size_t number, const Vec3& place, NearestPoints& nearest) const {
  if (level == 0) {
    for (std::size_t i = 0; i < points_.countIn(number); ++i) {
      const Vec3 at = placeOf(number * CloudPoints::kPerBlock + i);
      nearest.add(at, (at - place).squaredNorm());
    }
    return;
  }
  std::array<std::pair<double, std::size_t>, CloudPoints::kPerNode> parts;
  const std::size_t first = number * CloudPoints::kPerNode;
  const std::size_t count = std::min(CloudPoints::kPerNode, points_.countOn(level - 1) - first);
  for (std::size_t i = 0; i < count; ++i) parts[i] = {squareTo(points_.box(level - 1, first + i), place), first + i};
  std::sort(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count && nearest.takes(parts[i].first); ++i)
    look(level - 1, parts[i].second, place, nearest);
}

NearestPoints CloudSearch::around(std::size_t slot) const {
  NearestPoints nearest;
  look(points_.levels() - 1, 0, placeOf(slot), nearest);
  return nearest;
}

}  // namespace hl
