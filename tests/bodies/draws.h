// Draws: what random worlds are made from.
#pragma once

#include <cstdint>
#include <random>

#include "base/vec.h"
#include "environment.h"

namespace hl::test {

struct Draws {
  explicit Draws(std::uint64_t seed) : random(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  /// Unit.
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random), normal(random), normal(random)).normalized();
  }

  std::mt19937_64 random;
};

}  // namespace hl::test
