// What every fuzzer asks.
#pragma once

#include <cstdlib>

namespace hl::fuzz {

/// Aborts, which is what a fuzzer notices, unless it holds.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace hl::fuzz
