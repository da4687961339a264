#include "surfaces/implicit/find_bricks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "surfaces/implicit/sheet_bricks.h"

namespace hl {

namespace {

void addParts(const Sheet& sheet, int level, const Sheet::Place& at, std::vector<Sheet::Place>& parts) {
  constexpr std::uint32_t kPer = BrickPyramid::kBricks;
  Sheet::Place end{};
  for (std::size_t axis = 0; axis < 3; ++axis) end[axis] = std::min((at[axis] + 1) * kPer, sheet.side(level - 1, axis));
  for (std::uint32_t z = at[2] * kPer; z < end[2]; ++z) {
    for (std::uint32_t y = at[1] * kPer; y < end[1]; ++y) {
      for (std::uint32_t x = at[0] * kPer; x < end[0]; ++x) parts.push_back({x, y, z});
    }
  }
}

}  // namespace

KnownBricks findBricks(const Sheet& sheet, std::size_t most) {
  const GridFrame here;
  SheetBricks bricks(sheet, here, nullptr);
  std::vector<KnownBrick> found;
  std::vector<Sheet::Place> places{{0, 0, 0}};
  for (int level = sheet.levels() - 1; level > 0; --level) {
    const std::size_t before = found.size();
    std::vector<Sheet::Place> parts;
    for (const Sheet::Place& at : places) {
      const double bend = bricks.bendOf(level, at);
      if (std::isnan(bend)) continue;
      if (found.size() == most) {
        found.resize(before);
        return {level + 1, found};
      }
      found.push_back({level, at, bend});
      addParts(sheet, level, at, parts);
    }
    places = std::move(parts);
  }
  return {1, found};
}

}  // namespace hl
