#include "surfaces/implicit/known_bricks.h"

#include <bit>

namespace hl {

namespace {

std::uint64_t numberOf(int level, const std::array<std::uint32_t, 3>& at) {
  return static_cast<std::uint64_t>(level) << 48 | std::uint64_t{at[2]} << 32 | std::uint64_t{at[1]} << 16 | at[0];
}

}  // namespace

KnownBricks::KnownBricks(int lowest, const std::vector<KnownBrick>& bricks)
    : lowest_(lowest), slots_(std::bit_ceil(2 * bricks.size() + 1), Slot{kEmpty, 0}) {
  for (const KnownBrick& brick : bricks) {
    const std::uint64_t number = numberOf(brick.level, brick.at);
    slots_[slotOf(number)] = {number, brick.bend};
  }
}

// D. Knuth, The Art of Computer Programming, 6.4: multiplication, and the next free place.
std::size_t KnownBricks::slotOf(std::uint64_t number) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t slot = number * 0x9e3779b97f4a7c15 >> 32 & last;
  while (slots_[slot].number != number && slots_[slot].number != kEmpty) slot = (slot + 1) & last;
  return slot;
}

const double* KnownBricks::find(int level, const std::array<std::uint32_t, 3>& at) const {
  const Slot& slot = slots_[slotOf(numberOf(level, at))];
  return slot.number == kEmpty ? nullptr : &slot.bend;
}

}  // namespace hl
