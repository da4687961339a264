// The elementary functions of implicit surfaces: of numbers, of lists of eight numbers, and of intervals. Numbers and
// lists have the same bits on every processor: nothing but sums, products, quotients and roots is used.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "surfaces/implicit/interval.h"

namespace hl {

/// Eight numbers at once, as a cell has corners.
struct Lanes {
  std::array<double, 8> of{};
};

template <typename Function>
Lanes eachOf(const Function& function) {
  Lanes result;
  for (std::size_t i = 0; i < 8; ++i) result.of[i] = function(i);
  return result;
}

inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return eachOf([&](std::size_t i) { return a.of[i] + b.of[i]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return eachOf([&](std::size_t i) { return a.of[i] - b.of[i]; });
}
inline Lanes operator-(const Lanes& a) {
  return eachOf([&](std::size_t i) { return -a.of[i]; });
}
inline Lanes operator+(const Lanes& a, double b) {
  return eachOf([&](std::size_t i) { return a.of[i] + b; });
}
inline Lanes operator*(double a, const Lanes& b) {
  return eachOf([&](std::size_t i) { return a * b.of[i]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return eachOf([&](std::size_t i) { return a.of[i] * b.of[i]; });
}

// Of a number.

inline double squareOf(double a) { return a * a; }
inline double rootOf(double a) { return std::sqrt(a); }
/// 1 / a; 0 for 0, so that the gradient of a length is 0 where it has none.
inline double inverseOf(double a) { return a == 0 ? 0 : 1 / a; }

/// The nearest whole number; |a| < 2^51.
inline double nearestOf(double a) {
  constexpr double kShift = 0x1.8p52;
  return (a + kShift) - kShift;
}

/// sin(r) (-1)^n for |r| <= pi / 2, by Taylor's series: the first term left out is below 1e-17.
inline double sineOfRest(double r, double n) {
  const double x = r * r;
  double sum = 1.0 / 51090942171709440000.0;  // 21!
  sum = 1.0 / 121645100408832000.0 - x * sum;
  sum = 1.0 / 355687428096000.0 - x * sum;
  sum = 1.0 / 1307674368000.0 - x * sum;
  sum = 1.0 / 6227020800.0 - x * sum;
  sum = 1.0 / 39916800.0 - x * sum;
  sum = 1.0 / 362880.0 - x * sum;
  sum = 1.0 / 5040.0 - x * sum;
  sum = 1.0 / 120.0 - x * sum;
  sum = 1.0 / 6.0 - x * sum;
  const double odd = n - 2 * nearestOf(0.5 * n);
  return (1 - 2 * odd * odd) * (r - r * x * sum);
}

inline constexpr double kPiHigh = 0x1.921fb544p1, kPiLow = 0x1.0b4611a626331p-33;  // their sum is pi to 1e-26

inline double sineOf(double a) {
  const double n = nearestOf(a * M_1_PI);
  return sineOfRest((a - n * kPiHigh) - n * kPiLow, n);
}
inline double cosineOf(double a) {
  const double n = nearestOf(a * M_1_PI + 0.5), half = n - 0.5;
  return sineOfRest((a - half * kPiHigh) - half * kPiLow, n);
}

/// How far a is beyond -b or b, with its sign.
inline double excessOf(double a, double b) { return std::max(a - b, 0.0) + std::min(a + b, 0.0); }

// The bend of a blend: half of |d| rounded off within k of 0, so that (a + b) / 2 - bend(a - b) is the lesser of a and
// b but for where they are within k of each other. Once differentiable, and twice but for |d| = k.

inline double bendOf(double d, double k) { return std::abs(d) < k ? 0.25 * k + d * d / (4 * k) : 0.5 * std::abs(d); }
/// Its derivative.
inline double tiltOf(double d, double k) { return std::clamp(d / (2 * k), -0.5, 0.5); }

/// The lesser of a and b, lowered by at most k / 4 where they are within k of each other. No less than before where a
/// or b is no less than before.
inline double blendOf(double a, double b, double k) { return 0.5 * (a + b) - bendOf(a - b, k); }

// Of lists.

inline Lanes squareOf(const Lanes& a) { return a * a; }
inline Lanes rootOf(const Lanes& a) {
  return eachOf([&](std::size_t i) { return std::sqrt(a.of[i]); });
}
inline Lanes sineOf(const Lanes& a) {
  return eachOf([&](std::size_t i) { return sineOf(a.of[i]); });
}
inline Lanes cosineOf(const Lanes& a) {
  return eachOf([&](std::size_t i) { return cosineOf(a.of[i]); });
}
inline Lanes excessOf(const Lanes& a, double b) {
  return eachOf([&](std::size_t i) { return excessOf(a.of[i], b); });
}
inline Lanes inverseOf(const Lanes& a) {
  return eachOf([&](std::size_t i) { return inverseOf(a.of[i]); });
}
inline Lanes tiltOf(const Lanes& d, double k) {
  return eachOf([&](std::size_t i) { return tiltOf(d.of[i], k); });
}
inline Lanes blendOf(const Lanes& a, const Lanes& b, double k) {
  return eachOf([&](std::size_t i) { return blendOf(a.of[i], b.of[i], k); });
}

// Of intervals.

/// `top`: where its maxima are, each 2 pi; the minima are pi beside. What is nearly in the interval counts as in it.
template <typename Wave>
Interval waveOf(const Interval& a, double top, const Wave& wave) {
  constexpr double kTurn = 2 * M_PI, kNear = 1e-9, kRounding = 4e-15;
  if (!(a.high - a.low < kTurn)) return {-1, 1};
  const auto holds = [&](double peak) {
    return std::ceil((a.low - peak) / kTurn - kNear) <= std::floor((a.high - peak) / kTurn + kNear);
  };
  const double one = wave(a.low), other = wave(a.high);
  return {holds(top + M_PI) ? -1 : std::min(one, other) - kRounding, holds(top) ? 1 : std::max(one, other) + kRounding};
}
inline Interval sineOf(const Interval& a) {
  return waveOf(a, 0.5 * M_PI, [](double x) { return sineOf(x); });
}
inline Interval cosineOf(const Interval& a) {
  return waveOf(a, 0, [](double x) { return cosineOf(x); });
}
inline Interval excessOf(const Interval& a, double b) {
  return interval::outward(excessOf(a.low, b), excessOf(a.high, b));
}
inline Interval bendOf(const Interval& d, double k) {
  return interval::outward(bendOf(d.least(), k), bendOf(d.most(), k));
}
/// Its ends, half of 1, are exact: what is far from a blend has no part in it, however steep it is.
inline Interval tiltOf(const Interval& d, double k) {
  const Interval tilt = interval::outward(tiltOf(d.low, k), tiltOf(d.high, k));
  return {d.low >= k ? 0.5 : std::max(tilt.low, -0.5), d.high <= -k ? -0.5 : std::min(tilt.high, 0.5)};
}
inline Interval blendOf(const Interval& a, const Interval& b, double k) {
  const double margin = 1e-15 * (k + std::abs(a.low) + std::abs(b.low) + std::abs(a.high) + std::abs(b.high));
  if (!std::isfinite(margin)) return Interval::everything();
  return {blendOf(a.low, b.low, k) - margin, blendOf(a.high, b.high, k) + margin};
}

// Of a unit vector's coordinate.
inline double withinOne(double a) { return a; }
inline Lanes withinOne(const Lanes& a) { return a; }
inline Interval withinOne(const Interval& a) { return {std::clamp(a.low, -1.0, 1.0), std::clamp(a.high, -1.0, 1.0)}; }

// The second derivatives of excess^2 / 2 and of the bend: they jump.

inline double steepOf(double a, double b) { return b == 0 || std::abs(a) > b ? 1 : 0; }
inline Lanes steepOf(const Lanes& a, double b) {
  return eachOf([&](std::size_t i) { return steepOf(a.of[i], b); });
}
inline Interval steepOf(const Interval& a, double b) {
  return {b == 0 || a.least() > b ? 1.0 : 0.0, b == 0 || a.most() > b ? 1.0 : 0.0};
}
inline double roundOf(double d, double k) { return std::abs(d) < k ? 1 / (2 * k) : 0; }
inline Lanes roundOf(const Lanes& d, double k) {
  return eachOf([&](std::size_t i) { return roundOf(d.of[i], k); });
}
inline Interval roundOf(const Interval& d, double k) {
  return interval::outward(d.most() < k ? 1 / (2 * k) : 0, d.least() < k ? 1 / (2 * k) : 0);
}

// Of any of these.

template <typename T>
struct Turn {
  T sine, cosine;
};
template <typename T>
Turn<T> turnOf(const T& angle_rad) {
  return {sineOf(angle_rad), cosineOf(angle_rad)};
}

}  // namespace hl
