// In the place of oneTBB's header: see blocked_range.h.
#pragma once

#include "oneapi/tbb/blocked_range.h"

namespace oneapi::tbb {

/// For results that do not depend on how a range is split.
template <typename Value, typename Result, typename Body, typename Join>
Result parallel_reduce(const blocked_range<Value>& range, const Result& identity, const Body& body, const Join&) {
  return body(range, identity);
}

/// Splits and joins as oneTBB does, so that sums have the same bits.
template <typename Value, typename Result, typename Body, typename Join>
Result parallel_deterministic_reduce(const blocked_range<Value>& range, const Result& identity, const Body& body,
                                     const Join& join) {
  if (!range.is_divisible()) return body(range, identity);
  const blocked_range<Value> left(range.begin(), range.middle(), range.grainsize());
  const blocked_range<Value> right(range.middle(), range.end(), range.grainsize());
  return join(parallel_deterministic_reduce(left, identity, body, join),
              parallel_deterministic_reduce(right, identity, body, join));
}

}  // namespace oneapi::tbb
