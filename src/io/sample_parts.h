// Samples in messages of at most a few megabytes each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace hl {

/// Calls `take` with `part`, whose header is set, and then with parts that have samples and nothing else; `continues`
/// of a part says whether another one follows.
template <typename Part>
void takeInParts(Part part, const void* samples, std::size_t bytes, const std::function<void(Part& part)>& take) {
  constexpr std::size_t kPartBytes = std::size_t{4} << 20;
  const char* at = static_cast<const char*>(samples);
  while (bytes > 0) {
    const std::size_t some = std::min(bytes, kPartBytes);
    part.set_samples(at, some);
    at += some;
    bytes -= some;
    part.set_continues(bytes > 0);
    take(part);
    part.Clear();
  }
}

}  // namespace hl
