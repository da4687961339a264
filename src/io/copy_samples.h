// copySamples: numbers of a file, as they lie in it, to a sink that takes them as they are kept.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "io/byte_file.h"

namespace hl {

/// `count` numbers, `Given` in the file and with the bytes of each in the other order where `swap` is set. Memory does
/// not grow with their count. Returns how many are not the same number as `Kept`.
template <typename Given, typename Kept = Given, typename Sink>
std::uint64_t copySamples(ByteFile& in, std::uint64_t count, bool swap, Sink& sink) {
  constexpr std::uint64_t kAtOnce = 1 << 16;
  std::vector<Given> given(std::min(count, kAtOnce));
  std::vector<Kept> kept(std::is_same_v<Given, Kept> ? 0 : given.size());
  std::uint64_t rounded = 0;
  for (std::uint64_t left = count; left > 0;) {
    const std::size_t some = std::min(left, kAtOnce);
    in.read(given.data(), some * sizeof(Given));
    if (swap) std::transform(given.begin(), given.begin() + some, given.begin(), swapped<Given>);
    if constexpr (std::is_same_v<Given, Kept>) {
      sink.samples(given.data(), some * sizeof(Kept));
    } else {
      for (std::size_t i = 0; i < some; ++i) {
        kept[i] = static_cast<Kept>(+given[i]);
        rounded += static_cast<double>(kept[i]) != static_cast<double>(given[i]) && given[i] == given[i];
      }
      sink.samples(kept.data(), some * sizeof(Kept));
    }
    left -= some;
  }
  return rounded;
}

}  // namespace hl
