// Sheet: one smooth surface of an implicit function, as triangles of marching cells on a grid of its own, which are
// computed when they are asked for: the values at the corners of a cell are those of the function.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/element_id.h"
#include "surfaces/brick_pyramid.h"
#include "surfaces/implicit/implicit_function.h"
#include "surfaces/implicit/sheet_clip.h"
#include "surfaces/iso_cell.h"

namespace hl {

/// Cells are cubes. Coordinates are those of the function, in m.
struct SheetGrid {
  static constexpr std::uint32_t kMaxCells = 1U << 16;  ///< along an axis

  Vec3 origin = Vec3::Zero();
  double step = 1;
  std::array<std::uint32_t, 3> cells{1, 1, 1};

  Vec3 at(const Vec3& place) const { return origin + step * place; }
};

/// The number of a triangle of a surface.
struct SheetTriangle {
  std::size_t sheet = 0;
  std::array<std::uint32_t, 3> cell{};
  unsigned triangle = 0, piece = 0;

  ElementId id() const {
    const ElementId place = ElementId{cell[2]} << 32 | ElementId{cell[1]} << 16 | cell[0];
    return (ElementId{sheet} << 48 | place) << 9 | triangle << 5 | piece;
  }
  static SheetTriangle of(ElementId id) {
    const auto part = [id](int from, int bits) {
      return static_cast<std::uint32_t>(id >> from & ((std::uint64_t{1} << bits) - 1));
    };
    return {part(57, 6), {part(9, 16), part(25, 16), part(41, 16)}, part(5, 4), part(0, 5)};
  }
};

/// Immutable; RT-safe. The function must outlive it.
class Sheet {
 public:
  using Place = std::array<std::uint32_t, 3>;

  /// `slack`: see clipToSheet().
  Sheet(const ImplicitFunction& function, std::size_t number, const SheetGrid& grid, double slack);

  std::size_t number() const { return number_; }
  const SheetGrid& grid() const { return grid_; }
  const SmoothFunction& smooth() const { return function_->sheets()[number_]; }
  const ImplicitFunction& function() const { return *function_; }
  std::span<const ImplicitFunction::Condition> conditions() const { return function_->conditions(number_); }
  double slack() const { return slack_; }
  // Bricks as those of BrickPyramid.
  int levels() const { return levels_; }
  std::uint32_t side(int level, std::size_t axis) const {
    const std::uint64_t per_brick = BrickPyramid::cells(level);
    return static_cast<std::uint32_t>((grid_.cells[axis] + per_brick - 1) / per_brick);
  }
  /// Of a brick, or of a cell at level -1; it may reach beyond the grid.
  Box boxOf(int level, const Place& at) const;

  IsoCell cellAt(const Place& at) const;
  /// The corners of a triangle before it is cut.
  std::array<Vec3, 3> corners(const IsoCell& cell, unsigned triangle) const;
  /// What is left of a triangle. `sides`: known of a box that holds it.
  void pieces(const std::array<Vec3, 3>& corners, SheetPieces& out, const SheetSides& sides = {}) const {
    clipToSheet(*function_, number_, slack_, sides, corners, out);
  }

 private:
  const ImplicitFunction* function_;
  std::size_t number_;
  SheetGrid grid_;
  double slack_;
  int levels_ = 1;
};

}  // namespace hl
