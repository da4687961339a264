#include "surfaces/implicit/known_bricks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "surfaces/implicit/sheet_bricks.h"

namespace hl {

namespace {

// Adds the parts of a brick.
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

KnownBricks::KnownBricks(const Sheet& sheet, std::size_t most) : lowest_(sheet.levels()) {
  const GridFrame here;
  SheetBricks bricks(sheet, here, nullptr);
  std::vector<Slot> found;
  std::vector<Place> places{{0, 0, 0}};
  for (int level = sheet.levels() - 1; level > 0; --level) {
    const std::size_t before = found.size();
    std::vector<Place> parts;
    for (const Place& at : places) {
      const double bend = bricks.bendOf(level, at);
      if (std::isnan(bend)) continue;
      found.push_back({numberOf(level, at), bend});
      addParts(sheet, level, at, parts);
      if (found.size() > most) break;
    }
    if (found.size() > most) {
      found.resize(before);
      break;
    }
    lowest_ = level;
    places = std::move(parts);
  }
  fill(found);
}

void KnownBricks::fill(const std::vector<Slot>& found) {
  slots_.resize(std::bit_ceil(2 * found.size() + 1));
  for (const Slot& one : found) slots_[slotOf(one.brick)] = one;
}

// D. Knuth, The Art of Computer Programming, 6.4: multiplication, and the next free place.
std::size_t KnownBricks::slotOf(std::uint64_t brick) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t slot = brick * 0x9e3779b97f4a7c15 >> 32 & last;
  while (slots_[slot].brick != brick && slots_[slot].brick != kEmpty) slot = (slot + 1) & last;
  return slot;
}

const double* KnownBricks::find(int level, const Place& at) const {
  const Slot& slot = slots_[slotOf(numberOf(level, at))];
  return slot.brick == kEmpty ? nullptr : &slot.bend;
}

}  // namespace hl
