// Draws: what random worlds are made from.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>

#include "base/vec.h"

namespace hl::test {

/// What an environment variable says.
inline int numberIn(const char* variable, int otherwise) {
  const char* const said = std::getenv(variable);
  return said == nullptr ? otherwise : std::atoi(said);
}

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
