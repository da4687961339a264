#include "surfaces/sample_bound.h"

#include <bit>
#include <limits>

namespace hl {

namespace {

// Floats in their order: -infinity is -0x7f800000, infinity 0x7f800000.
constexpr std::int32_t kRankOfInfinity = 0x7f800000;
float floatOf(std::int32_t rank) { return rank < 0 ? -std::bit_cast<float>(-rank) : std::bit_cast<float>(rank); }

// The first number of those from `first` to before `end` of which is_beyond() is true, as it is of all that follow.
template <typename IsBeyond>
std::int32_t firstBeyond(std::int32_t first, std::int32_t end, const IsBeyond& is_beyond) {
  while (first < end) {
    const auto middle = static_cast<std::int32_t>(first + (std::int64_t{end} - first) / 2);
    is_beyond(middle) ? end = middle : first = middle + 1;
  }
  return first;
}

}  // namespace

SampleBound::SampleBound(const VoxelGrid& grid, double value, double inward) {
  const auto values = grid.values();
  const double scale = values.scale, offset = values.offset;
  const bool rises = inward * scale > 0;  // inside is what is beyond
  const auto is_beyond = [=](double sample) { return (inward * (offset + scale * sample - value) >= 0) == rises; };
  constexpr std::int32_t kMin = std::numeric_limits<std::int16_t>::min(),
                         kMax = std::numeric_limits<std::uint16_t>::max();
  whole = firstBeyond(kMin, kMax + 1, is_beyond);
  real = floatOf(
      firstBeyond(-kRankOfInfinity, kRankOfInfinity, [&](std::int32_t rank) { return is_beyond(floatOf(rank)); }));
}

}  // namespace hl
