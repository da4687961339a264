// HeightField: a grid of heights as a surface of triangles, two a cell, which are made when they are asked for.
#pragma once

#include <array>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/grid_frame.h"
#include "surfaces/height_cell.h"
#include "surfaces/height_grid.h"
#include "surfaces/height_pyramid.h"

namespace hl {

/// Numbers of triangles: 2 (row (columns - 1) + column) + half. Cells with a missing sample have none, and their
/// numbers are never proposed. Immutable; shares grid and pyramid with its copies in other places.
class HeightField final : public PrimitiveSource {
 public:
  /// Throws hl::Error where heights lie beyond 1e9 m. makeIndex() throws as requireSlopes() does.
  HeightField(std::shared_ptr<const HeightGrid> grid, const GridFrame& frame);

  ElementId count() const override;
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// At a sample by central differences, across a gap or at the rim by one-sided ones; in between interpolated.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  bool hasTexcoords() const override { return true; }
  Vec2 texcoord(ElementId id, std::size_t corner) const override;
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  /// Samples and pyramid.
  SharedMemory shared() const override { return {grid_.get(), grid_->bytes() + pyramid_->bytes()}; }
  /// Against the bilinear surface through the samples.
  double error_m() const override;
  /// Matter is below the triangles. Where there are none, beside the field and in its gaps, there is no matter.
  Site siteOf(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const HeightGrid& grid() const { return *grid_; }
  const HeightPyramid& pyramid() const { return *pyramid_; }
  const GridFrame& frame() const { return frame_; }
  std::uint64_t triangles() const override { return 2 * pyramid_->cells(); }

 private:
  using Corners = std::array<std::array<std::uint32_t, 2>, 3>;  // column and row of each

  HeightField(const HeightField& other, const GridFrame& frame);
  void checkFrame();
  Corners cornersOf(const HeightCell& cell) const;
  Vec3 pointAt(std::uint32_t column, std::uint32_t row) const {
    return frame_.point(column, row, grid_->at(column, row));
  }
  Vec3 normalAt(std::uint32_t column, std::uint32_t row) const;
  Vec2 texcoordAt(std::uint32_t column, std::uint32_t row) const;
  DrawnMesh every(std::uint32_t step) const;

  std::shared_ptr<const HeightGrid> grid_;
  std::shared_ptr<const HeightPyramid> pyramid_;
  GridFrame frame_;
  Mat3 across_ = Mat3::Identity();  // inverse of the frame's axes
  bool mirrored_ = false;           // the axes are right-handed: seen from above, rows go to the left of columns
  Box bounds_;
};

/// Throws hl::Error if all samples are missing, or lack a neighbour.
void requireTriangles(const HeightField& field);
/// Throws hl::Error if it is so steep that triangles of it could be slivers.
void requireSlopes(const HeightField& field);

}  // namespace hl
