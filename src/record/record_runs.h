// Record runs: what a ring of a loop still holds, in runs without a gap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/log_ring.h"

namespace hl {

/// At least one.
inline std::uint64_t countIn(double seconds, double rate_Hz) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(seconds * rate_Hz));
}

/// Gives `write` the records from `next` to `end` in runs without a gap, of at most `most`; what the ring no longer has
/// is passed over. `next` is the first that is not written yet, also when `write` throws.
template <typename Record, typename Write>
void forRuns(const LogRing<Record>& ring, std::uint64_t& next, std::uint64_t end, std::uint64_t most, Write write) {
  std::vector<Record> run;
  std::uint64_t at = next;
  const auto flush = [&] {
    if (!run.empty()) write(run, at - run.size());
    run.clear();
    next = at;
  };
  for (; at < end; ++at) {
    Record record;
    const bool there = ring.read(at, record);
    if (!there || run.size() == most) flush();
    if (there) run.push_back(record);
  }
  flush();
}

}  // namespace hl
