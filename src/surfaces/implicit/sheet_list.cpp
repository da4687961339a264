#include "surfaces/implicit/sheet_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

constexpr double kMinError_m = 1e-9, kMaxError_m = 1;
/// Of all sheets together, and of one. A sheet that others cut off has some ten times the looks for a box, as each of
/// these is one; most sheets end long before.
constexpr std::size_t kLooksOfAll = 400'000, kMaxLooks = 80'000, kMinLooks = 4'000;
/// Sides of cells: of a radius of curvature, so that no smooth part can hide between samples; of the whole.
constexpr double kOfRadius = 0.25, kOfSize = 0.125;
/// Of a cell: what is looked at beside the sheet, and what must be, as a diagonal is that long.
constexpr double kMargin = 2, kMinMargin = 1.8;
constexpr std::size_t kPatience = 8;      // times as many where these give nothing
constexpr int kMaxAttempts = 4;           // to find a good margin
constexpr int kMaxPatience = 16;          // to find any: what curves beside a plane may be far smaller than it
constexpr double kSlackRounding = 1e-12;  // of coordinates

// Bounds that are found are a little larger, so that no flat side lies in their own.
Box boundsFor(const ImplicitSpec& spec) {
  if (spec.bounds) {
    const Box& box = *spec.bounds;
    const bool sound = box.min.allFinite() && box.max.allFinite() && box.size().minCoeff() > 1e-9 &&
                       box.min.cwiseAbs().maxCoeff() <= 1e6 && box.max.cwiseAbs().maxCoeff() <= 1e6;
    if (!sound) throw Error("bounds must be a box within 1e6, with min below max by more than 1e-9");
    return box;
  }
  const std::optional<Box> own = boundsOf(spec.expression);
  if (!own) throw Error("it has no end, as a half-space or a gyroid has none: give bounds");
  if (own->empty()) throw Error("it is empty");
  const double more = 0.0137 * own->size().maxCoeff();
  return {own->min - Vec3::Constant(more), own->max + Vec3::Constant(more)};
}

std::string tooSharp(const Vec3& at, double error_m) {
  std::array<char, 256> line{};
  std::snprintf(
      line.data(), line.size(),
      "near (%.4g, %.4g, %.4g), in its own lengths before transform and units, its surface is too sharp, too thin or "
      "too large for an error of %.3g: allow more, or round it off",
      at.x(), at.y(), at.z(), error_m);
  return line.data();
}

}  // namespace

SheetList::SheetList(const ImplicitSpec& of) : spec(of), function(of.expression), within(boundsFor(of)) {
  if (!(spec.error_m >= kMinError_m && spec.error_m <= kMaxError_m)) throw Error("error must be from 1e-9 to 1");
  const std::size_t count = function.sheets().size();
  sheets.reserve(count);
  const std::size_t looks = std::clamp(kLooksOfAll / count, kMinLooks, kMaxLooks);
  for (std::size_t number = 0; number < count; ++number) add(number, looks);
  if (sheets.empty()) throw Error("there is no surface within its bounds");
}

// How many times the error of a triangle of a sheet that is of the whole, once it is cut off where the value of another
// is above twice that error times its steepest slope. Where it is least steep this is so much farther away, and the
// value was off by the error again.
double SheetList::growthOf(std::size_t number, const SheetMeasure& measure) const {
  return function.conditions(number).empty() ? 1 : 1 + 2 * measure.unevenness();
}

// The bound must hold a cell beside the sheet, so it is found once to know how large cells are, and once more. There it
// may turn out that the sheet is nowhere after all: what is left of a sheet just within another body.
void SheetList::add(std::size_t number, std::size_t most_looks) {
  const auto step_for = [&](const SheetMeasure& measure) {
    const double largest = kOfSize * measure.bounds.size().maxCoeff();
    if (!(measure.bend_per_m > 0)) return largest;
    const double most_error = spec.error_m / growthOf(number, measure);
    return std::min({largest, kOfRadius / measure.bend_per_m, std::sqrt(2 * most_error / measure.bend_per_m)});
  };
  SheetSearch search(function, number, within);
  search.refine(most_looks);
  SheetMeasure measure = search.result();
  if (!std::isfinite(measure.bend_per_m)) {  // it is large, or bodies are thin
    search.refine(kPatience * most_looks);
    measure = search.result();
  }
  if (measure.bounds.empty()) return;
  double step = 0;
  double margin = std::isfinite(measure.bend_per_m) ? kMargin * step_for(measure) : 0;
  for (int attempt = 0; attempt < (step > 0 ? kMaxAttempts : kMaxPatience) && step < margin / kMinMargin;
       ++attempt, margin *= 0.5) {
    search.widen(margin);
    search.refine(most_looks / 3);
    const SheetMeasure wide = search.result();
    if (wide.bounds.empty()) return;
    const double possible = std::min(step_for(wide), margin / kMinMargin);
    if (!(std::isfinite(wide.bend_per_m) && possible > step)) continue;
    step = possible;
    measure = wide;
  }
  const double cells = measure.bounds.size().maxCoeff() / step + 1;
  if (!(cells < SheetGrid::kMaxCells)) throw Error(tooSharp(measure.sharpest, spec.error_m));
  SheetGrid grid{measure.bounds.min - Vec3::Constant(0.3 * step), step, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.cells[axis] =
        static_cast<std::uint32_t>(std::ceil(measure.bounds.size()[static_cast<Eigen::Index>(axis)] / step + 0.6));
  const double error = 0.5 * step * step * measure.bend_per_m, steepest = measure.cut_slope.high;
  const double rounding = kSlackRounding * (within.min.cwiseAbs() + within.max.cwiseAbs()).maxCoeff();
  sheets.emplace_back(function, number, grid, 2 * error * steepest + rounding);
  bounds.extend(Box{grid.origin, grid.at(Vec3(grid.cells[0], grid.cells[1], grid.cells[2]))});
  error_m = std::max(error_m, growthOf(number, measure) * error + rounding);
  off = std::max(off, 3 * error * std::max(steepest, measure.own_slope.high) + rounding);
  triangles += 1.5 * measure.area_m2 / (step * step);
}

std::vector<Sheet> SheetList::coarser(double factor) const {
  std::vector<Sheet> result;
  for (const Sheet& sheet : sheets) {
    SheetGrid grid = sheet.grid();
    const double largest = grid.step * *std::max_element(grid.cells.begin(), grid.cells.end()) * kOfSize;
    const double by = std::max(1.0, std::min(factor, largest / grid.step));
    grid.step *= by;
    for (std::uint32_t& cells : grid.cells) cells = static_cast<std::uint32_t>(std::ceil(cells / by));
    result.emplace_back(function, sheet.number(), grid, by * by * sheet.slack());
  }
  return result;
}

std::size_t SheetList::bytes() const { return sizeof(*this) + function.bytes() + sheets.size() * sizeof(Sheet); }

}  // namespace hl
