// Histogram of durations with bounded relative error: percentiles of millions of samples in fixed memory.
#pragma once

#include <array>
#include <cstdint>

namespace hl {

/// Log-linear buckets: 32 per power of two, so a percentile is at most 1/32 too high. Durations in nanoseconds.
/// add() is RT-safe. One thread at a time.
class Histogram {
 public:
  void add(std::uint64_t duration_ns);
  void clear();
  std::uint64_t count() const { return count_; }
  std::uint64_t max_ns() const { return max_ns_; }
  /// Smallest bucket top that at least `fraction` (0..1) of the samples do not exceed; 0 when empty.
  std::uint64_t percentile_ns(double fraction) const;

 private:
  static constexpr int kSubBits = 5;
  static constexpr int kBuckets = (64 - kSubBits + 1) << kSubBits;
  static int bucketOf(std::uint64_t duration_ns);
  static std::uint64_t topOf(int bucket);
  std::array<std::uint32_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::uint64_t max_ns_ = 0;
};

}  // namespace hl
