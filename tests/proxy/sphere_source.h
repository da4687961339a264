// SphereSource: a sphere whose triangles are made on request, and the same sphere as a mesh. Rows of cells between
// circles of latitude; the cells at the poles are one triangle each.
#pragma once

#include <cmath>

#include "geometry/primitive_source.h"
#include "scene/model.h"

namespace hl::test {

class SphereSource final : public PrimitiveSource {
 public:
  SphereSource(double radius, std::uint32_t rows, std::uint32_t columns)
      : radius_(radius), rows_(rows), columns_(columns) {}

  ElementId count() const override { return ElementId{2} * columns_ * (rows_ - 1); }
  std::array<Vec3, 3> corners(ElementId id) const override {
    const auto [row, column, upper] = cellOf(id);
    const Vec3 a = point(row, column), b = point(row, column + 1);
    const Vec3 c = point(row + 1, column), d = point(row + 1, column + 1);
    return upper ? std::array{a, c, d} : std::array{a, d, b};
  }
  Vec3 trueNormal(ElementId, const Vec3& point) const override { return point.normalized(); }
  Box bounds() const override {
    Box box;
    for (std::uint32_t row = 0; row <= rows_; ++row) {
      for (std::uint32_t column = 0; column < columns_; ++column) box.extend(point(row, column));
    }
    return box;
  }
  std::unique_ptr<const SpatialIndex> makeIndex() const override { return std::make_unique<Index>(*this); }
  std::size_t bytes() const override { return sizeof(*this); }
  double error_m() const override { return radius_ * (1 - std::cos(M_PI / std::min(rows_, columns_))); }

  /// Its triangles in the same order, with its normals.
  Model model() const {
    Model model;
    for (ElementId id = 0; id < count(); ++id) {
      const auto first = static_cast<std::uint32_t>(model.positions.size());
      for (const Vec3& corner : corners(id)) {
        model.positions.push_back(corner);
        model.normals.push_back(trueNormal(id, corner));
      }
      model.triangles.push_back({first, first + 1, first + 2});
    }
    return model;
  }

 private:
  struct Cell {
    std::uint32_t row, column;
    bool upper;
  };
  // Numbers: those of the first row, of its lower half alone; of the rows between, two a cell; of the last row.
  Cell cellOf(ElementId id) const {
    if (id < columns_) return {0, static_cast<std::uint32_t>(id), true};
    id -= columns_;
    const auto row = static_cast<std::uint32_t>(1 + id / (2 * ElementId{columns_}));
    const auto in_row = static_cast<std::uint32_t>(id % (2 * ElementId{columns_}));
    if (row == rows_ - 1) return {row, in_row, false};
    return {row, in_row / 2, in_row % 2 == 0};
  }
  Vec3 point(std::uint32_t row, std::uint32_t column) const {
    if (row == 0) return {0, radius_, 0};
    if (row == rows_) return {0, -radius_, 0};
    const double polar = M_PI * row / rows_, around = 2 * M_PI * (column % columns_) / columns_;
    return radius_ * Vec3(std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around));
  }

  /// Proposes the rows between two circles of latitude; no tree, no memory.
  class Index final : public SpatialIndex {
   public:
    explicit Index(const SphereSource& of) : of_(of) {}
    std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const override {
      return forRows(centre.y() - radius, centre.y() + radius, visit);
    }
    std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double,
                      FunctionRef<double(ElementId, double)> visit) const override {
      double limit = 1;
      const double end = from.y() + motion.y();
      return forRows(std::min(from.y(), end) - radius, std::max(from.y(), end) + radius,
                     [&](ElementId id) { limit = visit(id, limit); });
    }
    IndexStats stats() const override { return {}; }

   private:
    std::size_t forRows(double low, double high, FunctionRef<void(ElementId)> visit) const {
      const double r = of_.radius_;
      const auto angle = [&](double y) { return std::acos(std::clamp(y / r, -1.0, 1.0)) / M_PI * of_.rows_; };
      // A row beyond on each side, for rounding.
      const auto first = static_cast<std::int64_t>(std::floor(angle(high))) - 1;
      const auto last = static_cast<std::int64_t>(std::floor(angle(low))) + 1;
      std::size_t volumes = 0;
      for (ElementId id = 0; id < of_.count(); ++id) {
        const std::int64_t row = of_.cellOf(id).row;
        if (row < first || row > last) continue;
        visit(id);
        ++volumes;
      }
      return volumes;
    }
    const SphereSource& of_;
  };

  const double radius_;
  const std::uint32_t rows_, columns_;
};

}  // namespace hl::test
