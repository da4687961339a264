// IsoCells: the cells of a volume that a surface of equal value crosses, and the corners of its triangles there.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "geometry/element_id.h"
#include "surfaces/brick_pyramid.h"
#include "surfaces/grid_frame.h"
#include "surfaces/iso_cell.h"
#include "surfaces/sample_bound.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// On which side of the surface the matter is: where values are at least the iso value (bone in CT), or at most (a
/// signed distance).
enum class SolidSide : std::uint8_t { kAbove, kBelow };

struct IsoValue {
  double value = 0;
  SolidSide solid = SolidSide::kAbove;
  bool operator==(const IsoValue&) const = default;
};

/// What somebody says of an iso value; nothing: it stays as it is.
struct IsoChoice {
  std::optional<double> value{};
  std::optional<SolidSide> solid{};
  bool operator==(const IsoChoice&) const = default;

  /// Both together; of what `before` says too this counts.
  IsoChoice after(const IsoChoice& before) const {
    return {value ? value : before.value, solid ? solid : before.solid};
  }
  IsoValue over(const IsoValue& before) const { return {value.value_or(before.value), solid.value_or(before.solid)}; }
};

/// Samples with their bounds, shared by all surfaces of a volume. Immutable.
struct Volume {
  /// Throws hl::Error where the scale takes values beyond what float32 has.
  explicit Volume(VoxelGrid of);

  std::size_t bytes() const { return grid.bytes() + pyramid.bytes(); }

  VoxelGrid grid;
  BrickPyramid pyramid;
};

/// Triangle `n` of the cell at (x, y, z) has the number 16 ((z ny + y) nx + x) + n, nx and ny the numbers of cells.
/// Cells with a missing sample have no triangles. Immutable; RT-safe.
class IsoCells {
 public:
  static constexpr ElementId kPerCell = 16;
  using Place = std::array<std::uint32_t, 3>;

  IsoCells(std::shared_ptr<const Volume> volume, const GridFrame& frame, const IsoValue& iso)
      : volume_(std::move(volume)),
        frame_(frame),
        iso_(iso),
        inward_(iso.solid == SolidSide::kAbove ? 1 : -1),
        bound_(volume_->grid, iso.value, inward_) {}

  const std::shared_ptr<const Volume>& volume() const { return volume_; }
  const GridFrame& frame() const { return frame_; }
  const IsoValue& iso() const { return iso_; }
  /// 1 or -1: sign of the change of values on the way into the matter.
  double inward() const { return inward_; }
  /// Parts the samples of the matter from the others.
  const SampleBound& bound() const { return bound_; }

  IsoCell at(const Place& place) const;
  Place placeOf(ElementId id) const;
  ElementId idOf(const IsoCell& cell, unsigned triangle) const;
  /// Above the numbers of all triangles.
  ElementId count() const;
  /// m.
  Vec3 point(const Vec3& place) const { return frame_.point(place.x(), place.y(), place.z()); }
  /// Calls visit(cell) for each cell that the surface crosses.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    volume_->pyramid.forEachHolding(iso_.value, [&](const Place& first, const Place& end) {
      for (std::uint32_t z = first[2]; z < end[2]; ++z) {
        for (std::uint32_t y = first[1]; y < end[1]; ++y) {
          for (std::uint32_t x = first[0]; x < end[0]; ++x) {
            if (const IsoCell cell = at({x, y, z}); cell.triangles != nullptr) visit(cell);
          }
        }
      }
    });
  }

 private:
  std::shared_ptr<const Volume> volume_;
  GridFrame frame_;
  IsoValue iso_;
  double inward_;
  SampleBound bound_;
};

}  // namespace hl
