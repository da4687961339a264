#include "base/plain_math.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hl::plain {

namespace {

// pi / 2 in three parts; the first two have 33 bits, so that products with whole numbers up to 2^20 are exact.
constexpr double kQuarterHigh = 0x1.921fb544p+0, kQuarterMiddle = 0x1.0b4611a6p-34, kQuarterLow = 0x1.3198a2e037073p-69;
// ln 2 likewise: the first part has 32 bits.
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

// 1 / n!: every n! up to 20 is a double.
constexpr std::size_t kSeries = 21;
constexpr std::array<double, kSeries> inverseFactorials() {
  std::array<double, kSeries> inverse{};
  double factorial = 1;
  for (std::size_t n = 0; n < kSeries; ++n) {
    factorial *= n > 0 ? static_cast<double>(n) : 1;
    inverse[n] = 1 / factorial;
  }
  return inverse;
}
constexpr std::array<double, kSeries> kInverseFactorial = inverseFactorials();

// The sum of x^k / (first + step k)! for k up to `last`: the Taylor series of the functions below.
double series(double x, std::size_t first, std::size_t step, std::size_t last) {
  double sum = 0;
  for (std::size_t k = last + 1; k-- > 0;) sum = kInverseFactorial[first + step * k] + x * sum;
  return sum;
}

// On |x| <= pi / 4: the first term left out is below 1e-18 of the sum.
double sinNearZero(double x) { return x * series(-x * x, 1, 2, 8); }
double cosNearZero(double x) { return series(-x * x, 0, 2, 9); }

// The sine of x + quarters * pi / 2.
double sinFrom(double x, std::int64_t quarters) {
  constexpr double kMax = 1e9;  // rad; beyond it the rest is not below a quarter
  if (!(std::abs(x) <= kMax)) return std::numeric_limits<double>::quiet_NaN();
  const double k = std::floor(x / kQuarterHigh + 0.5);
  const double rest = ((x - k * kQuarterHigh) - k * kQuarterMiddle) - k * kQuarterLow;
  switch ((static_cast<std::int64_t>(k) + quarters) & 3) {
    case 0:
      return sinNearZero(rest);
    case 1:
      return cosNearZero(rest);
    case 2:
      return -sinNearZero(rest);
    default:
      return -cosNearZero(rest);
  }
}

// atan t = t - t^3 / 3 + ..., |t| <= tan(pi / 16): the first term left out is below 1e-17 of the sum.
double atanNearZero(double t) {
  constexpr int kTerms = 11;
  double sum = 0;
  for (int k = kTerms; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t * t * sum;
  return t * sum;
}

}  // namespace

double sin(double x) { return sinFrom(x, 0); }
double cos(double x) { return sinFrom(x, 1); }

double angleOf(double x, double y) {
  if (y > x) return 2 * 0x1.921fb54442d18p-1 - angleOf(y, x);
  const auto half = [](double t) { return t / (1 + std::sqrt(1 + t * t)); };  // tan(a / 2) from tan a
  return 4 * atanNearZero(half(half(y / x)));
}

double expOfNegative(double x) {
  constexpr double kNothing = -700;
  if (!(x > kNothing)) return 0;
  const double k = std::floor(x / kLn2High + 0.5);
  const double rest = (x - k * kLn2High) - k * kLn2Low;
  return std::ldexp(series(rest, 0, 1, 14), static_cast<int>(k));
}

// Newton's method from above comes down until rounding stops it.
double cubeRoot(double n) {
  double root = n;
  while (true) {
    const double next = root - (root * root * root - n) / (3 * root * root);
    if (!(next < root)) return root;
    root = next;
  }
}

}  // namespace hl::plain
