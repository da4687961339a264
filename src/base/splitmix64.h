// splitmix64: spreads the bits of a number over 64 (Steele, Lea and Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014). For hashes and for noise; not for secrets.
#pragma once

#include <cstdint>

namespace hl {

/// What a generator whose state is `x` gives next. RT-safe.
constexpr std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace hl
