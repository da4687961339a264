#include "tick/cost.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "base/clock.h"
#include "geometry/wide_bvh.h"

namespace hl::bench {

namespace {

double buildTime_ns(const Shape& shape, HierarchyKind hierarchy) {
  const std::int64_t start_ns = monotonicNow_ns();
  const auto index = makeIndex(shape.primitives, hierarchy);
  return static_cast<double>(monotonicNow_ns() - start_ns);
}

double buildTimeOnOneThread_ns(const Shape& shape, HierarchyKind hierarchy) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  return buildTime_ns(shape, hierarchy);
}

// Of a shape that goes on changing: the middle time of many in a row. The first need memory such as the machine may
// never have used, which takes longer than they do.
double refitTime_ns(const Shape& shape) {
  constexpr std::size_t kMin = 9;
  constexpr double kMin_ns = 0.3e9;
  const auto* const tree = dynamic_cast<const WideBvh*>(shape.index.get());
  if (tree == nullptr) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times_ns;
  WideBvh refitted = tree->refit(shape.primitives);
  for (double all_ns = 0; times_ns.size() < kMin || all_ns < kMin_ns; all_ns += times_ns.back()) {
    const std::int64_t start_ns = monotonicNow_ns();
    refitted = refitted.refit(shape.primitives);
    times_ns.push_back(static_cast<double>(monotonicNow_ns() - start_ns));
  }
  std::sort(times_ns.begin(), times_ns.end());
  return times_ns[times_ns.size() / 2];
}

}  // namespace

Cost costOf(const Shape& shape, HierarchyKind hierarchy) {
  const auto primitives = static_cast<double>(shape.primitives.size());
  return {buildTimeOnOneThread_ns(shape, hierarchy) / primitives, buildTime_ns(shape, hierarchy) / primitives,
          refitTime_ns(shape) / primitives, static_cast<double>(shape.index->stats().bytes) / primitives,
          static_cast<double>(shape.geometryBytes()) / primitives};
}

}  // namespace hl::bench
