#include "tick/cost.h"

#include <tbb/global_control.h>

#include "base/clock.h"

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

}  // namespace

Cost costOf(const Shape& shape, HierarchyKind hierarchy) {
  const auto primitives = static_cast<double>(shape.primitives.size());
  return {buildTimeOnOneThread_ns(shape, hierarchy) / primitives, buildTime_ns(shape, hierarchy) / primitives,
          static_cast<double>(shape.index->stats().bytes) / primitives,
          static_cast<double>(shape.geometryBytes()) / primitives};
}

}  // namespace hl::bench
