#include "surfaces/height_field.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "surfaces/height_index.h"
#include "surfaces/normal_between.h"
#include "surfaces/slope.h"

namespace hl {

HeightField::HeightField(std::shared_ptr<const HeightGrid> grid, const GridFrame& frame)
    : grid_(std::move(grid)), pyramid_(std::make_shared<const HeightPyramid>(*grid_)), frame_(frame) {
  checkFrame();
}

HeightField::HeightField(const HeightField& other, const GridFrame& frame)
    : grid_(other.grid_), pyramid_(other.pyramid_), frame_(frame) {
  checkFrame();
}

void requireTriangles(const HeightField& field) {
  if (field.triangles() == 0)
    throw Error(
        "its samples are missing, are no finite numbers (of 32 bits), or lack neighbours: there is nothing to touch");
}

// A triangle has at least the area |det| / (2 |M_w|): its shadow along the third axis.
void requireSlopes(const HeightField& field) {
  const Mat3& axes = field.frame().axes;
  const double range = field.pyramid().highest() - field.pyramid().lowest();
  const double longest = axes.col(0).norm() + axes.col(1).norm() + range * axes.col(2).norm();
  if (std::abs(axes.determinant()) > 10 * kSliver * longest * longest * axes.col(2).norm()) return;
  throw Error(
      "a height field rises by 1e5 times its spacing or more: give it another spacing or vertical scale, or name the "
      "value of missing samples");
}

void HeightField::checkFrame() {
  const Mat3& axes = frame_.axes;
  const double determinant = axes.determinant();
  if (!axes.allFinite() || !frame_.origin.allFinite() || !(std::abs(determinant) > 0))
    throw Error("a height field needs spacings and a vertical scale that are not 0");
  for (const double column : {0.0, grid_->columns() - 1.0}) {
    for (const double row : {0.0, grid_->rows() - 1.0}) {
      for (const double value : {pyramid_->lowest(), pyramid_->highest()})
        bounds_.extend(frame_.point(column, row, value));
    }
  }
  if (!withinReach(bounds_.min) || !withinReach(bounds_.max))
    throw Error("a height field reaches beyond 1e9 m: give it another scale, or name the value of missing samples");
  mirrored_ = determinant > 0;
  across_ = axes.inverse();
}

// The diagonal of a cell goes from its first corner to the one opposite.
Site HeightField::siteOf(const Vec3& point) const {
  const Vec3 at = across_ * (point - frame_.origin);
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() <= grid_->columns() - 1.0 && at.y() <= grid_->rows() - 1.0))
    return Site::kOpen;
  const std::uint32_t i = std::min(static_cast<std::uint32_t>(at.x()), grid_->columns() - 2);
  const std::uint32_t j = std::min(static_cast<std::uint32_t>(at.y()), grid_->rows() - 2);
  if (!grid_->hasCell(i, j)) return Site::kOpen;
  const double u = at.x() - i, v = at.y() - j;
  const double first = grid_->at(i, j), opposite = grid_->at(i + 1, j + 1);
  const double side = u >= v ? grid_->at(i + 1, j) : grid_->at(i, j + 1);  // the third corner of the half
  const double height = first + std::max(u, v) * (side - first) + std::min(u, v) * (opposite - side);
  return at.z() < height ? Site::kMatter : Site::kOpen;
}

ElementId HeightField::count() const { return 2 * ElementId{grid_->columns() - 1} * (grid_->rows() - 1); }

HeightField::Corners HeightField::cornersOf(const HeightCell& cell) const {
  const std::uint32_t i = cell.column, j = cell.row;
  Corners corners{{{i, j}, {i + 1, j + 1}, {i + 1, j}}};
  if (cell.half == 1) corners = {{{i, j}, {i, j + 1}, {i + 1, j + 1}}};
  if (mirrored_) std::swap(corners[1], corners[2]);
  return corners;
}

std::array<Vec3, 3> HeightField::corners(ElementId id) const {
  const Corners at = cornersOf(cellOf(id, grid_->columns()));
  return {pointAt(at[0][0], at[0][1]), pointAt(at[1][0], at[1][1]), pointAt(at[2][0], at[2][1])};
}

Vec3 HeightField::normalAt(std::uint32_t column, std::uint32_t row) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double here = grid_->at(column, row);
  const double west = column > 0 ? grid_->at(column - 1, row) : kNone;
  const double east = column + 1 < grid_->columns() ? grid_->at(column + 1, row) : kNone;
  const double north = row > 0 ? grid_->at(column, row - 1) : kNone;
  const double south = row + 1 < grid_->rows() ? grid_->at(column, row + 1) : kNone;
  const Vec3 across = frame_.axes.col(0) + slopeOf(west, here, east) * frame_.axes.col(2);
  const Vec3 down = frame_.axes.col(1) + slopeOf(north, here, south) * frame_.axes.col(2);
  return (mirrored_ ? across.cross(down) : down.cross(across)).normalized();
}

Vec3 HeightField::trueNormal(ElementId id, const Vec3& point) const {
  const Corners at = cornersOf(cellOf(id, grid_->columns()));
  return normalBetween(corners(id), point, [&](std::size_t i) { return normalAt(at[i][0], at[i][1]); });
}

// An image lies on it as a map does: its upper left corner on the first sample, its lower right one on the last.
Vec2 HeightField::texcoordAt(std::uint32_t column, std::uint32_t row) const {
  const double last_column = grid_->columns() - 1.0, last_row = grid_->rows() - 1.0;
  return {column / last_column, (last_row - row) / last_row};
}

Vec2 HeightField::texcoord(ElementId id, std::size_t corner) const {
  const auto [column, row] = cornersOf(cellOf(id, grid_->columns()))[corner];
  return texcoordAt(column, row);
}

// Two triangles and the bilinear surface differ most in the middle of the diagonal, by a quarter of the twist.
double HeightField::error_m() const {
  using Range = oneapi::tbb::blocked_range<std::uint32_t>;
  const auto largest = [](double a, double b) { return b > a ? b : a; };  // not a number is never larger
  const double twist = oneapi::tbb::parallel_reduce(
      Range(0, grid_->rows() - 1), 0.0,
      [&](const Range& rows, double most) {
        for (std::uint32_t j = rows.begin(); j < rows.end(); ++j) {
          for (std::uint32_t i = 0; i + 1 < grid_->columns(); ++i)
            most = largest(
                most, std::abs(grid_->at(i, j) + grid_->at(i + 1, j + 1) - grid_->at(i + 1, j) - grid_->at(i, j + 1)));
        }
        return most;
      },
      largest);
  return 0.25 * twist * frame_.axes.col(2).norm();
}

// Only now: what a file says of its scale may have been changed.
std::unique_ptr<const SpatialIndex> HeightField::makeIndex() const {
  requireSlopes(*this);
  return std::make_unique<HeightIndex>(*grid_, *pyramid_, frame_, bounds_);
}

std::shared_ptr<const PrimitiveSource> HeightField::placed(const Mat3& linear, const Vec3& offset) const {
  return std::shared_ptr<const PrimitiveSource>(new HeightField(*this, frame_.placed(linear, offset)));
}

DrawnMesh HeightField::drawn(std::size_t most_triangles) const {
  std::uint32_t step = 1;
  const auto cells = [&](std::uint32_t side) { return std::size_t{(side - 2) / step + 1}; };
  while (2 * cells(grid_->columns()) * cells(grid_->rows()) > most_triangles &&
         step < std::max(grid_->columns(), grid_->rows()))
    ++step;
  return every(step);
}

// The last column and row are there whatever the step, so that the rim is where it is.
DrawnMesh HeightField::every(std::uint32_t step) const {
  const auto places = [&](std::uint32_t side) { return (side - 2) / step + 2; };
  const auto at = [&](std::uint32_t place, std::uint32_t side) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{place} * step, side - 1));
  };
  const std::uint32_t columns = places(grid_->columns()), rows = places(grid_->rows());
  DrawnMesh mesh;
  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> number(std::size_t{columns} * rows, kNone);
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t column = at(i, grid_->columns()), row = at(j, grid_->rows());
      if (std::isnan(grid_->at(column, row))) continue;
      number[std::size_t{j} * columns + i] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(pointAt(column, row));
      mesh.normals.push_back(normalAt(column, row));
      mesh.texcoords.push_back(texcoordAt(column, row));
    }
  }
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const auto of = [&](const std::array<std::uint32_t, 2>& corner) {
        return number[std::size_t{corner[1]} * columns + corner[0]];
      };
      if (std::max({of({i, j}), of({i + 1, j}), of({i, j + 1}), of({i + 1, j + 1})}) == kNone) continue;
      for (const unsigned half : {0U, 1U}) {
        const Corners corner = cornersOf({i, j, half});
        mesh.triangles.push_back({of(corner[0]), of(corner[1]), of(corner[2])});
      }
    }
  }
  return mesh;
}

}  // namespace hl
