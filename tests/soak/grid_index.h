// GridIndex: equal cells, each with the primitives whose box reaches into it. So plain that it judges the hierarchies
// where testing every primitive would take too long.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/primitive.h"
#include "geometry/spatial_index.h"

namespace hl::soak {

class GridIndex final : public SpatialIndex {
 public:
  /// `side` of a cell in metres.
  GridIndex(std::span<const Primitive> primitives, double side) : side_(side) {
    for (const Primitive& primitive : primitives) {
      for (const Vec3& vertex : primitive.vertex) {
        min_ = min_.cwiseMin(vertex);
        max_ = max_.cwiseMax(vertex);
      }
    }
    size_ = cellOf(max_) + Cell::Ones();
    cells_.resize(static_cast<std::size_t>(size_.prod()));
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      const auto& v = primitives[i].vertex;
      const Vec3 min = v[0].cwiseMin(v[1]).cwiseMin(v[2]), max = v[0].cwiseMax(v[1]).cwiseMax(v[2]);
      forEachCell(min, max, [&](std::size_t cell) { cells_[cell].push_back(i); });
    }
  }

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const override {
    const Vec3 reach = Vec3::Constant(radius * (1 + kRounding));
    std::size_t looked = 0;
    forEachCell(centre - reach, centre + reach, [&](std::size_t cell) {
      for (const std::uint32_t primitive : cells_[cell]) visit(primitive);
      looked += cells_[cell].size();
    });
    return looked;
  }

  /// All of the way's box, whatever the limit.
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double /*soon*/,
                    FunctionRef<double(ElementId, double)> visit) const override {
    const Vec3 to = from + motion, reach = Vec3::Constant(radius * (1 + kRounding));
    double limit = 1;
    std::size_t looked = 0;
    forEachCell(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach, [&](std::size_t cell) {
      for (const std::uint32_t primitive : cells_[cell]) limit = visit(primitive, limit);
      looked += cells_[cell].size();
    });
    return looked;
  }

  IndexStats stats() const override { return {0, cells_.size(), 0, 0}; }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
  static constexpr double kRounding = 1e-9;

  Cell cellOf(const Vec3& p) const { return ((p - min_) / side_).array().floor().cast<std::int64_t>(); }

  // The cells that the box min .. max reaches into.
  template <typename Visit>
  void forEachCell(const Vec3& min, const Vec3& max, Visit visit) const {
    const Cell first = cellOf(min).cwiseMax(0), last = cellOf(max).cwiseMin(size_ - Cell::Ones());
    for (std::int64_t i = first[0]; i <= last[0]; ++i) {
      for (std::int64_t j = first[1]; j <= last[1]; ++j) {
        for (std::int64_t k = first[2]; k <= last[2]; ++k)
          visit(static_cast<std::size_t>((i * size_[1] + j) * size_[2] + k));
      }
    }
  }

  double side_;
  Vec3 min_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max_ = -min_;
  Cell size_ = Cell::Zero();
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace hl::soak
