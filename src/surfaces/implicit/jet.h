// Jet: the value of a function at a point with its first derivatives, or its first and second, by the rules of
// differentiation (forward mode). With intervals in the place of numbers it bounds them over a box.
#pragma once

#include <array>
#include <cstddef>

#include "surfaces/implicit/elementary.h"

namespace hl {

/// `kOrder`: 1 or 2. Second derivatives are xx, yy, zz, yz, zx, xy.
template <typename Number, int kOrder>
struct Jet {
  static constexpr std::size_t kSecond = kOrder == 2 ? 6 : 0;

  Number value{};
  std::array<Number, 3> slope{};
  std::array<Number, kSecond> bend{};
};

namespace jet {

inline constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}}};

/// f(u), from f, f' and f'' there.
template <typename N, int kOrder>
Jet<N, kOrder> composed(const Jet<N, kOrder>& u, const N& f, const N& f1, const N& f2) {
  Jet<N, kOrder> result;
  result.value = f;
  for (std::size_t i = 0; i < 3; ++i) result.slope[i] = f1 * u.slope[i];
  for (std::size_t i = 0; i < result.bend.size(); ++i) {
    const auto [a, b] = kPairs[i];
    const N product = a == b ? squareOf(u.slope[a]) : u.slope[a] * u.slope[b];
    result.bend[i] = f1 * u.bend[i] + f2 * product;
  }
  return result;
}

template <typename J, typename Operation>
J eachOf(const J& a, const J& b, const Operation& operation) {
  J result;
  result.value = operation(a.value, b.value);
  for (std::size_t i = 0; i < 3; ++i) result.slope[i] = operation(a.slope[i], b.slope[i]);
  for (std::size_t i = 0; i < result.bend.size(); ++i) result.bend[i] = operation(a.bend[i], b.bend[i]);
  return result;
}

}  // namespace jet

template <typename N, int kOrder>
Jet<N, kOrder> operator+(const Jet<N, kOrder>& a, const Jet<N, kOrder>& b) {
  return jet::eachOf(a, b, [](const N& x, const N& y) { return x + y; });
}
template <typename N, int kOrder>
Jet<N, kOrder> operator-(const Jet<N, kOrder>& a) {
  return jet::eachOf(a, a, [](const N& x, const N&) { return -x; });
}
template <typename N, int kOrder>
Jet<N, kOrder> operator+(const Jet<N, kOrder>& a, double b) {
  Jet<N, kOrder> result = a;
  result.value = a.value + b;
  return result;
}
template <typename N, int kOrder>
Jet<N, kOrder> operator*(double a, const Jet<N, kOrder>& b) {
  return jet::eachOf(b, b, [a](const N& x, const N&) { return a * x; });
}
template <typename N, int kOrder>
Jet<N, kOrder> operator*(const Jet<N, kOrder>& a, const Jet<N, kOrder>& b) {
  Jet<N, kOrder> result;
  result.value = a.value * b.value;
  for (std::size_t i = 0; i < 3; ++i) result.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
  for (std::size_t i = 0; i < result.bend.size(); ++i) {
    const auto [j, k] = jet::kPairs[i];
    result.bend[i] = (a.value * b.bend[i] + b.value * a.bend[i]) + (a.slope[j] * b.slope[k] + a.slope[k] * b.slope[j]);
  }
  return result;
}

template <typename N, int kOrder>
Turn<Jet<N, kOrder>> turnOf(const Jet<N, kOrder>& u) {
  const auto [sine, cosine] = turnOf(u.value);
  return {jet::composed(u, sine, cosine, -sine), jet::composed(u, cosine, -sine, -cosine)};
}
template <typename N, int kOrder>
Jet<N, kOrder> blendOf(const Jet<N, kOrder>& a, const Jet<N, kOrder>& b, double k) {
  const Jet<N, kOrder> difference = a + -b;
  const N tilt = tiltOf(difference.value, k);
  const N of_a = -tilt + 0.5, of_b = tilt + 0.5;
  Jet<N, kOrder> result;
  result.value = blendOf(a.value, b.value, k);
  for (std::size_t i = 0; i < 3; ++i) result.slope[i] = of_a * a.slope[i] + of_b * b.slope[i];
  const N round = roundOf(difference.value, k);
  for (std::size_t i = 0; i < result.bend.size(); ++i) {
    const auto [j, l] = jet::kPairs[i];
    const N product = j == l ? squareOf(difference.slope[j]) : difference.slope[j] * difference.slope[l];
    result.bend[i] = (of_a * a.bend[i] + of_b * b.bend[i]) + -(round * product);
  }
  return result;
}

// The length of a vector of excesses over `half`, which are the values themselves where it is 0. Once differentiable,
// where an excess is not. With n = u / |u|, its gradient is the sum of n u', and its second derivatives are
// (sum of u' u'^T - |u|' |u|'^T) / |u| + sum of n u'': intervals of these are narrow, as n is one of a unit vector.

template <typename T, std::size_t kCount>
T lengthOf(const std::array<T, kCount>& u, const std::array<double, kCount>& half) {
  T sum = squareOf(excessOf(u[0], half[0]));
  for (std::size_t i = 1; i < kCount; ++i) sum = sum + squareOf(excessOf(u[i], half[i]));
  return rootOf(sum);
}

template <typename N, int kOrder, std::size_t kCount>
Jet<N, kOrder> lengthOf(const std::array<Jet<N, kOrder>, kCount>& u, const std::array<double, kCount>& half) {
  std::array<N, kCount> values, unit;
  for (std::size_t i = 0; i < kCount; ++i) values[i] = u[i].value;
  Jet<N, kOrder> result;
  result.value = lengthOf(values, half);
  const N inverse = inverseOf(result.value);
  for (std::size_t i = 0; i < kCount; ++i) unit[i] = withinOne(excessOf(u[i].value, half[i]) * inverse);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kCount; ++i) result.slope[axis] = result.slope[axis] + unit[i] * u[i].slope[axis];
  }
  const auto product = [](const Jet<N, kOrder>& of, std::size_t a, std::size_t b) {
    return a == b ? squareOf(of.slope[a]) : of.slope[a] * of.slope[b];
  };
  for (std::size_t n = 0; n < result.bend.size(); ++n) {
    const auto [a, b] = jet::kPairs[n];
    N across = -product(result, a, b), along{};
    for (std::size_t i = 0; i < kCount; ++i) {
      across = across + steepOf(u[i].value, half[i]) * product(u[i], a, b);
      along = along + unit[i] * u[i].bend[n];
    }
    result.bend[n] = inverse * across + along;
  }
  return result;
}

}  // namespace hl
