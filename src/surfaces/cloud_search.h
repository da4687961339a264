// CloudSearch: the points of a cloud that are nearest to a place, and the plane through them. For setup: not RT-safe.
#pragma once

#include <array>
#include <cstddef>

#include "surfaces/cloud_points.h"

namespace hl {

/// The nearest points so far, nearest first. Metres along the axes of the lattice, from its first point.
class CloudNeighbours {
 public:
  static constexpr std::size_t kNeighbours = 12, kMax = kNeighbours + 1;  // with the point itself

  std::size_t size() const { return size_; }
  const Vec3& operator[](std::size_t i) const { return at_[i]; }
  /// Squared distance of the last, m^2.
  double farthest() const { return size_ > 0 ? square_[size_ - 1] : 0; }
  bool takes(double square) const { return size_ < kMax || square < square_[kMax - 1]; }
  void add(const Vec3& at, double square);

  /// Distance between neighbours of as many points on a square grid, m; 0 of one point.
  double spacing() const;
  /// Of the plane with the least squares of distances; any normal to their line, if they lie on one.
  Vec3 normal() const;

 private:
  std::array<double, kMax> square_{};
  std::array<Vec3, kMax> at_{};
  std::size_t size_ = 0;
};

class CloudSearch {
 public:
  explicit CloudSearch(const CloudPoints& points) : points_(points), step_(points.lattice().step) {}
  CloudNeighbours around(std::size_t slot) const;
  /// The same of each point of a block, several times as fast.
  std::array<CloudNeighbours, CloudPoints::kPerBlock> aroundAll(std::size_t block) const;

 private:
  /// Blocks, not too many.
  struct Neighbourhood {
    static constexpr std::size_t kMax = 64;
    std::array<std::size_t, kMax> blocks;
    std::size_t size = 0;
    bool whole = true;
  };
  Vec3 placeOf(std::size_t slot) const { return step_.cwiseProduct(points_.at(slot)); }
  double squareTo(const LatticeBox& box, const Vec3& place) const;
  double squareBetween(const LatticeBox& a, const LatticeBox& b) const;
  void look(int level, std::size_t number, const Vec3& place, CloudNeighbours& nearest) const;
  void lookIn(std::size_t block, const Vec3& place, CloudNeighbours& nearest) const;
  void gather(int level, std::size_t number, std::size_t around, double square, Neighbourhood& near) const;

  const CloudPoints& points_;
  const Vec3 step_;
};

}  // namespace hl
