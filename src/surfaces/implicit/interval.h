// Interval: all numbers from `low` to `high`. Results hold every result of numbers from the operands: each bound is
// moved outward by more than the rounding of one operation. Infinite bounds say that nothing is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

struct Interval {
  double low = 0, high = 0;

  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  static Interval everything() { return {-kNoEnd, kNoEnd}; }

  bool holds(double value) const { return low <= value && value <= high; }
  double middle() const { return 0.5 * low + 0.5 * high; }
  /// Half its length, rounded up.
  double half() const { return (0.5 * high - 0.5 * low) * (1 + 1e-15); }
  /// The largest and the smallest absolute value.
  double most() const { return std::max(-low, high); }
  double least() const { return std::max({low, -high, 0.0}); }
};

namespace interval {

inline Interval outward(double low, double high, double part = 0x1p-51) {
  return {low - part * std::abs(low), high + part * std::abs(high)};
}
/// 0 times infinity is 0: the infinite bound stands for large numbers.
inline double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }
inline double sum(double a, double b, double unknown) {
  const double s = a + b;
  return std::isnan(s) ? unknown : s;
}

}  // namespace interval

inline Interval operator+(const Interval& a, const Interval& b) {
  return interval::outward(interval::sum(a.low, b.low, -Interval::kNoEnd),
                           interval::sum(a.high, b.high, Interval::kNoEnd));
}
inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator-(const Interval& a, const Interval& b) { return a + (-b); }
inline Interval operator+(const Interval& a, double b) { return interval::outward(a.low + b, a.high + b); }
inline Interval operator*(double a, const Interval& b) {
  const double one = interval::times(a, b.low), other = interval::times(a, b.high);
  return interval::outward(std::min(one, other), std::max(one, other));
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = interval::times(a.low, b.low), q = interval::times(a.low, b.high),
               r = interval::times(a.high, b.low), s = interval::times(a.high, b.high);
  return interval::outward(std::min({p, q, r, s}), std::max({p, q, r, s}));
}
inline Interval squareOf(const Interval& a) {
  const double least = a.least(), most = a.most();
  return interval::outward(least * least, most * most);
}
/// What is below 0 does not count.
inline Interval rootOf(const Interval& a) {
  return interval::outward(std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0)));
}
/// 1 / a for a >= 0.
inline Interval inverseOf(const Interval& a) {
  return interval::outward(a.high > 0 ? 1 / a.high : Interval::kNoEnd, a.low > 0 ? 1 / a.low : Interval::kNoEnd);
}

}  // namespace hl
