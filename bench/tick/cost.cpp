#include "tick/cost.h"

#include <tbb/global_control.h>

#include <limits>

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

// Of a shape that goes on changing: the second one in a row. The memory of the first may be such as the machine has
// never used, which takes as long as the refit itself.
double refitTime_ns(const Shape& shape) {
  const auto* const tree = dynamic_cast<const WideBvh*>(shape.index.get());
  if (tree == nullptr) return std::numeric_limits<double>::quiet_NaN();
  tree->refit(shape.primitives);
  const std::int64_t start_ns = monotonicNow_ns();
  const WideBvh refitted = tree->refit(shape.primitives);
  return static_cast<double>(monotonicNow_ns() - start_ns);
}

}  // namespace

Cost costOf(const Shape& shape, HierarchyKind hierarchy) {
  const auto primitives = static_cast<double>(shape.primitives.size());
  return {buildTimeOnOneThread_ns(shape, hierarchy) / primitives, buildTime_ns(shape, hierarchy) / primitives,
          refitTime_ns(shape) / primitives, static_cast<double>(shape.index->stats().bytes) / primitives,
          static_cast<double>(shape.geometryBytes()) / primitives};
}

}  // namespace hl::bench
