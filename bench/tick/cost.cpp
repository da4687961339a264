#include "tick/cost.h"

#include <tbb/global_control.h>

#include <cstddef>
#include <vector>

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

template <typename T>
std::size_t heapBytes(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

std::size_t bytesWithoutIndex(const Shape& shape) {
  const Model& model = shape.model;
  return heapBytes(model.positions) + heapBytes(model.normals) + heapBytes(model.texcoords) +
         heapBytes(model.triangles) + heapBytes(model.segments) + heapBytes(model.points) +
         heapBytes(shape.primitives) + heapBytes(shape.material_of);
}

}  // namespace

Cost costOf(const Shape& shape, HierarchyKind hierarchy) {
  const auto primitives = static_cast<double>(shape.primitives.size());
  const auto index_bytes = static_cast<double>(shape.index->stats().bytes);
  return {buildTimeOnOneThread_ns(shape, hierarchy) / primitives, buildTime_ns(shape, hierarchy) / primitives,
          index_bytes / primitives, (index_bytes + static_cast<double>(bytesWithoutIndex(shape))) / primitives};
}

}  // namespace hl::bench
