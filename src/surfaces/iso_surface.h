// IsoSurface: where the values of a volume pass one value: the triangles of marching cells (marching_cell.h), which are
// made when they are asked for. Another value is another IsoSurface over the same volume, and costs next to nothing.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "geometry/primitive_source.h"
#include "surfaces/iso_cells.h"
#include "surfaces/matter.h"

namespace hl {

/// The surface ends at the rim of the volume. Immutable.
class IsoSurface final : public PrimitiveSource {
 public:
  /// `frame`: from sample numbers along x, y, z to metres. Throws hl::Error for a value that is not finite, and where
  /// the volume lies beyond 1e9 m or its cells are too thin to have triangles.
  IsoSurface(std::shared_ptr<const Volume> volume, const GridFrame& frame, const IsoValue& iso,
             std::shared_ptr<const MatterTable> matter = nullptr);

  ElementId count() const override { return cells_.count(); }
  /// About two for each cell that a plane through a brick of cells crosses.
  std::uint64_t triangles() const override { return triangles_; }
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// Down the gradient of the values, by central differences at the samples, linear in between.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  /// The volume.
  SharedMemory shared() const override { return {volume().get(), volume()->bytes()}; }
  /// Between the triangles and the surface of the trilinear values, at most the diagonal of a cell.
  double error_m() const override;
  /// By the samples of the cell around it. Where one is missing, outside of the volume, and without a surface anywhere,
  /// there is no matter.
  Site siteOf(const Vec3& point) const override;
  bool resists() const override { return matter_ && matter_->resists(); }
  /// By the values at the corners of its cell, trilinear; nothing where one is missing, and outside of the volume.
  MatterForce matterAt(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const IsoCells& cells() const { return cells_; }
  const std::shared_ptr<const Volume>& volume() const { return cells_.volume(); }
  const GridFrame& frame() const { return cells_.frame(); }
  const IsoValue& iso() const { return cells_.iso(); }
  /// What its values feel like; null: nobody has said.
  const std::shared_ptr<const MatterTable>& matter() const { return matter_; }
  /// Whether there is a triangle, which triangles() does not report: the bricks that may have one are searched.
  bool crossesAny() const;

 private:
  class Drawing;

  std::optional<std::array<double, kCellCorners>> valuesAround(const Vec3& place, IsoCells::Place& at) const;
  Vec3 gradientAt(const IsoCells::Place& at) const;
  void checkFrame() const;
  void measure();
  double errorOf_m(const IsoCell& cell, double longest_step_m) const;
  DrawnMesh drawnInFull() const;

  IsoCells cells_;
  Mat3 across_;  // inverse of the frame's axes
  bool mirrored_ = false;
  std::shared_ptr<const MatterTable> matter_;
  Box bounds_;
  std::uint64_t triangles_ = 0;
};

/// Throws hl::Error if all samples are missing.
void requireValues(const Volume& volume);
/// The same, and with the range of the values if no sample and its neighbour have the iso value between them.
void requireSurface(const IsoSurface& surface);

}  // namespace hl
