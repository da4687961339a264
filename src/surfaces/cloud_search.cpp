#include "surfaces/cloud_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace hl {

void CloudNeighbours::add(const Vec3& at, double square) {
  if (!takes(square)) return;
  std::size_t place = size_ < kMax ? size_++ : kMax - 1;
  for (; place > 0 && square_[place - 1] > square; --place) {
    square_[place] = square_[place - 1];
    at_[place] = at_[place - 1];
  }
  square_[place] = square;
  at_[place] = at;
}

// n points are in a disc of their farthest: pi d^2 = n s^2.
double CloudNeighbours::spacing() const { return std::sqrt(farthest() * M_PI / static_cast<double>(size_)); }

Vec3 CloudNeighbours::normal() const {
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

double CloudSearch::squareBetween(const LatticeBox& a, const LatticeBox& b) const {
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double below = static_cast<double>(b.low[axis]) - a.high[axis];
    const double above = static_cast<double>(a.low[axis]) - b.high[axis];
    const double out = step_[static_cast<Eigen::Index>(axis)] * std::max({below, above, 0.0});
    square += out * out;
  }
  return square;
}

void CloudSearch::lookIn(std::size_t block, const Vec3& place, CloudNeighbours& nearest) const {
  for (std::size_t i = 0; i < points_.countIn(block); ++i) {
    const Vec3 at = placeOf(block * CloudPoints::kPerBlock + i);
    nearest.add(at, (at - place).squaredNorm());
  }
}

void CloudSearch::look(int level, std::size_t number, const Vec3& place, CloudNeighbours& nearest) const {
  if (level == 0) return lookIn(number, place, nearest);
  std::array<std::pair<double, std::size_t>, CloudPoints::kPerNode> parts;
  const std::size_t first = number * CloudPoints::kPerNode;
  const std::size_t count = std::min(CloudPoints::kPerNode, points_.countOn(level - 1) - first);
  for (std::size_t i = 0; i < count; ++i) parts[i] = {squareTo(points_.box(level - 1, first + i), place), first + i};
  std::sort(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count && nearest.takes(parts[i].first); ++i)
    look(level - 1, parts[i].second, place, nearest);
}

// Other blocks within a distance of this one.
void CloudSearch::gather(int level, std::size_t number, std::size_t around, double square, Neighbourhood& near) const {
  if (!near.whole || (level == 0 && number == around)) return;
  if (squareBetween(points_.box(level, number), points_.box(0, around)) > square) return;
  if (level == 0) {
    near.whole = near.size < Neighbourhood::kMax;
    if (near.whole) near.blocks[near.size++] = number;
    return;
  }
  const std::size_t first = number * CloudPoints::kPerNode;
  const std::size_t end = std::min(first + CloudPoints::kPerNode, points_.countOn(level - 1));
  for (std::size_t i = first; i < end; ++i) gather(level - 1, i, around, square, near);
}

// No point has its neighbours farther than those of its own block are.
std::array<CloudNeighbours, CloudPoints::kPerBlock> CloudSearch::aroundAll(std::size_t block) const {
  std::array<CloudNeighbours, CloudPoints::kPerBlock> nearest;
  const std::size_t count = points_.countIn(block), first = block * CloudPoints::kPerBlock;
  double farthest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    lookIn(block, placeOf(first + i), nearest[i]);
    farthest = std::max(farthest, nearest[i].farthest());
  }
  Neighbourhood near;
  near.whole = count >= CloudNeighbours::kMax;
  gather(points_.levels() - 1, 0, block, farthest, near);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 place = placeOf(first + i);
    if (!near.whole) nearest[i] = around(first + i);
    for (std::size_t k = 0; near.whole && k < near.size; ++k) {
      if (nearest[i].takes(squareTo(points_.box(0, near.blocks[k]), place))) lookIn(near.blocks[k], place, nearest[i]);
    }
  }
  return nearest;
}

CloudNeighbours CloudSearch::around(std::size_t slot) const {
  CloudNeighbours nearest;
  look(points_.levels() - 1, 0, placeOf(slot), nearest);
  return nearest;
}

}  // namespace hl
