#include "base/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hl {

int Histogram::bucketOf(std::uint64_t duration_ns) {
  if (duration_ns < (1u << kSubBits)) return static_cast<int>(duration_ns);
  const int octave = static_cast<int>(std::bit_width(duration_ns)) - kSubBits;  // >= 1
  return (octave << kSubBits) + static_cast<int>((duration_ns >> (octave - 1)) & ((1u << kSubBits) - 1));
}

std::uint64_t Histogram::topOf(int bucket) {
  const int octave = bucket >> kSubBits;
  const std::uint64_t sub = static_cast<std::uint64_t>(bucket) & ((1u << kSubBits) - 1);
  if (octave == 0) return sub;
  return (((std::uint64_t{1} << kSubBits) + sub + 1) << (octave - 1)) - 1;
}

void Histogram::add(std::uint64_t duration_ns) {
  ++buckets_[static_cast<std::size_t>(bucketOf(duration_ns))];
  ++count_;
  max_ns_ = std::max(max_ns_, duration_ns);
}

void Histogram::clear() { *this = Histogram(); }

std::uint64_t Histogram::percentile_ns(double fraction) const {
  if (count_ == 0) return 0;
  const auto wanted =
      static_cast<std::uint64_t>(std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (int bucket = 0; bucket < kBuckets; ++bucket) {
    seen += buckets_[static_cast<std::size_t>(bucket)];
    if (seen >= wanted && seen > 0) return std::min(topOf(bucket), max_ns_);
  }
  return max_ns_;
}

}  // namespace hl
