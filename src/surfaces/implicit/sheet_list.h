// SheetList: an implicit function with the grids of its sheets, chosen so that their triangles are within an error.
#pragma once

#include <vector>

#include "surfaces/implicit/implicit_spec.h"
#include "surfaces/implicit/sheet.h"
#include "surfaces/implicit/sheet_measure.h"

namespace hl {

/// Immutable. Not to be moved: the sheets refer to the function.
struct SheetList {
  /// As ImplicitSurface's.
  explicit SheetList(const ImplicitSpec& of);
  SheetList(const SheetList&) = delete;
  SheetList& operator=(const SheetList&) = delete;

  /// With cells `factor` times as large.
  std::vector<Sheet> coarser(double factor) const;
  std::size_t bytes() const;

  ImplicitSpec spec;
  ImplicitFunction function;
  Box within;                 ///< m
  std::vector<Sheet> sheets;  ///< those that have a surface there
  Box bounds;                 ///< of these
  double error_m = 0;
  double off = 0;        ///< how much the function may be from 0 on a triangle
  double triangles = 0;  ///< about

 private:
  void add(std::size_t number, std::size_t most_looks);
  double growthOf(std::size_t number, const SheetMeasure& measure) const;
};

}  // namespace hl
