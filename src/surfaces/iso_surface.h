// IsoSurface: where the values of a volume pass one value: the triangles of marching cells (marching_cell.h), which are
// made when they are asked for. Another value is another IsoSurface over the same volume, and costs next to nothing.
#pragma once

#include <array>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/brick_pyramid.h"
#include "surfaces/grid_frame.h"
#include "surfaces/marching_cell.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// On which side of the surface the matter is: where values are at least the iso value (bone in CT), or at most (a
/// signed distance).
enum class SolidSide : std::uint8_t { kAbove, kBelow };

struct IsoValue {
  double value = 0;
  SolidSide solid = SolidSide::kAbove;
};

/// Samples with their bounds, shared by all surfaces of a volume. Immutable.
struct Volume {
  explicit Volume(VoxelGrid of) : grid(std::move(of)), pyramid(grid) {}

  std::size_t bytes() const { return grid.bytes() + pyramid.bytes(); }

  VoxelGrid grid;
  BrickPyramid pyramid;
};

/// A cell that the surface crosses.
struct IsoCell {
  std::array<std::uint32_t, 3> at{};         ///< its first sample
  std::array<double, kCellCorners> value{};  ///< at its corners, relative to the iso value: inside is >= 0
  const CellTriangles* triangles = nullptr;  ///< null: no sample may be missing, and not all are on one side
};

/// Triangle `n` of the cell at (x, y, z) has the number 16 ((z ny + y) nx + x) + n, nx and ny the numbers of cells.
/// Cells with a missing sample have no triangles, and the surface ends at the rim of the volume. Immutable.
class IsoSurface final : public PrimitiveSource {
 public:
  static constexpr ElementId kPerCell = 16;

  /// `frame`: from sample numbers along x, y, z to metres. Throws hl::Error for a value that is not finite, and where
  /// the volume lies beyond 1e9 m or its cells are too thin to have triangles.
  IsoSurface(std::shared_ptr<const Volume> volume, const GridFrame& frame, const IsoValue& iso);

  ElementId count() const override;
  /// About two for each cell that a plane through a brick of cells crosses.
  std::uint64_t triangles() const override { return triangles_; }
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// Down the gradient of the values, by central differences at the samples, linear in between.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  /// The volume.
  SharedMemory shared() const override { return {volume_.get(), volume_->bytes()}; }
  /// Between the triangles and the surface of the trilinear values, at most the diagonal of a cell.
  double error_m() const override;
  /// By the samples of the cell around it. Where one is missing, and outside of the volume, there is no matter.
  Site siteOf(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const std::shared_ptr<const Volume>& volume() const { return volume_; }
  const GridFrame& frame() const { return frame_; }
  const IsoValue& iso() const { return iso_; }
  /// RT-safe.
  IsoCell cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;
  ElementId idOf(const IsoCell& cell, unsigned triangle) const;
  /// Whether triangle number `triangle` of the cell has an area: where a sample lies on the surface, some do not.
  /// RT-safe.
  bool exists(const IsoCell& cell, unsigned triangle) const;

 private:
  class Drawing;

  Vec3 point(const Vec3& place) const { return frame_.point(place.x(), place.y(), place.z()); }
  Vec3 placeOn(const IsoCell& cell, unsigned edge) const;
  Vec3 middleOf(const IsoCell& cell) const;
  Vec3 gradientAt(const std::array<std::uint32_t, 3>& at) const;
  std::array<std::uint32_t, 3> cellOf(ElementId id) const;
  void checkFrame() const;
  void measure();
  double errorOf_m(const IsoCell& cell, double longest_step_m) const;
  /// Calls visit(cell) for each cell that the surface crosses.
  template <typename Visit>
  void forEachCell(const Visit& visit) const;
  DrawnMesh drawnInFull() const;

  std::shared_ptr<const Volume> volume_;
  GridFrame frame_;
  IsoValue iso_;
  double outward_ = -1;  // of the relative values, along the gradient of the values
  Mat3 across_;          // inverse of the frame's axes
  bool mirrored_ = false;
  Box bounds_;
  std::uint64_t triangles_ = 0;
};

}  // namespace hl
