// Sheet measure: where a sheet is, and how strongly it is curved: with certainty, from intervals of its first and
// second derivatives over boxes that are halved where most is to be gained.
#pragma once

#include <cstddef>
#include <memory>
#include <queue>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "surfaces/implicit/implicit_function.h"

namespace hl {

/// Of a sheet, where it is the surface of the whole, in a box; with what cuts it off.
struct SheetMeasure {
  Box bounds;  ///< empty: it is nowhere
  /// Bound of |second derivatives| / |gradient|, of the sheet and of what it is cut off by; infinite where no gradient
  /// could be proved not to vanish.
  double bend_per_m = 0;
  Interval own_slope{Interval::kNoEnd, 0};  ///< of |gradient|, of the sheet
  Interval cut_slope{Interval::kNoEnd, 0};  ///< of what it is cut off by, where that is; as it is here: by nothing
  double area_m2 = 0;                       ///< about
  Vec3 sharpest = Vec3::Zero();             ///< where the bend may be largest

  /// How much farther away from what cuts it off one place may be than another where its value is the same; infinite
  /// where no gradient could be proved not to vanish.
  double unevenness() const { return cut_slope.high > 0 ? cut_slope.high / cut_slope.low : 1; }
};

/// Boxes that hold the sheet; those are halved where most is to be gained. Setup only.
class SheetSearch {
 public:
  /// The function must outlive it.
  SheetSearch(const ImplicitFunction& function, std::size_t sheet, const Box& within);

  /// Evaluates functions over boxes `most_looks` times, or a few more; less where that is enough.
  void refine(std::size_t most_looks);
  /// From now on the bounds hold everywhere up to `margin` m from the sheet.
  void widen(double margin);
  SheetMeasure result() const;

 private:
  struct Piece {
    bool coarse;  // these are halved first
    double bend_per_m;
    Interval own_slope, cut_slope;
    Box box;
    std::size_t order;
    double effort() const;
    bool operator<(const Piece& other) const;
  };

  // One period of a sheet that repeats itself: what holds there holds everywhere.
  struct Period {
    std::size_t sheet;
    std::unique_ptr<SheetSearch> search;
    SheetMeasure measure{{}, Interval::kNoEnd, {0, Interval::kNoEnd}};
    double volume_m3 = 1;
  };
  struct WithoutConditions {};

  void addSheets(std::size_t node);
  SheetSearch(const ImplicitFunction& function, std::size_t sheet, const Box& within, WithoutConditions);
  void addPeriod(std::size_t sheet, const Box& within);
  void searchPeriods(std::size_t most_looks);
  const Period* periodOf(std::size_t sheet) const;
  void add(const Box& box);
  void look(std::size_t sheet, const SmoothFunction::Space& space, Piece& piece, Interval& slope);

  const ImplicitFunction& function_;
  const std::size_t sheet_;
  const double size_;  // m
  double margin_ = 0;
  std::span<const ImplicitFunction::Condition> conditions_;
  std::vector<std::size_t> others_;  // sheets that it is cut off by
  std::priority_queue<Piece> boxes_;
  std::size_t order_ = 0, looked_ = 0;
  double about_ = 0;             // the bend is about so large somewhere
  std::vector<Period> periods_;  // of this sheet and the others, where these repeat themselves within the box
};

/// A box as intervals, larger by `margin` on each side and by what rounding may need.
SmoothFunction::Space spaceOf(const Box& box, double margin);

}  // namespace hl
