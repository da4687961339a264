#include "batch/batch.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <limits>

#include "batch/on_threads.h"
#include "proxy/field_forces.h"
#include "tools/trace.h"

namespace hl {

namespace {

using Range = oneapi::tbb::blocked_range<std::size_t>;

}  // namespace

void traceBatch(const Snapshot& scene, const ProxySettings& settings, std::span<const PathSample> samples,
                std::span<const std::size_t> ends, int threads, BatchSink sink) {
  TraceSettings trace;
  trace.proxy = settings;
  onThreads(threads, [&] {
    oneapi::tbb::parallel_for(std::size_t{0}, ends.size(), [&](std::size_t path) {
      const std::size_t begin = path == 0 ? 0 : ends[path - 1];
      std::size_t next = begin;
      runTrace(scene, trace, samples.subspan(begin, ends[path] - begin), [&](const TraceRow& row) {
        sink(next++, {row.proxy, row.force, row.contacts, row.injected_J});
      });
    });
  });
}

void FingerBatch::step(std::span<const Vec3> fingers, int threads, BatchSink sink) {
  constexpr std::size_t kGrain = 16;  // each range begins with nothing read
  onThreads(threads, [&] {
    oneapi::tbb::parallel_for(Range(0, states_.size(), kGrain), [&](const Range& range) {
      ManyRecentPrimitives recent;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const SceneAt scene(*scene_, 0, recent);
        if (begun_[i] == 0) states_[i] = startProxy(scene, settings_, fingers[i]);
        begun_[i] = 1;
        const TickReport report = tick(states_[i], scene, settings_, fingers[i]);
        const Vec3 force_N =
            settings_.spring_N_m * (report.target - fingers[i]) + fieldForces(scene, fingers[i]).force_N;
        sink(i, {states_[i].position, force_N, static_cast<int>(report.contacts.size()), report.injected_J});
      }
    });
  });
}

NearestPoint nearestPoint(const SceneAt& scene, const Vec3& point) {
  NearestPoint nearest;
  if (!scene.nearest(point, nearest.primitive, nearest.at))
    nearest.at.distance = std::numeric_limits<double>::infinity();
  return nearest;
}

std::uint64_t numberInModel(const Snapshot& scene, const PrimitiveId& primitive) {
  const Shape& shape = scene.shape(primitive.instance);
  std::uint64_t before = 0;  // of what stays, and of the bodies before this one
  for (std::uint32_t i = 0; i < primitive.instance; ++i) before += scene.shape(i).model.elements();
  return before + (shape.source ? primitive.element : shape.primitives.elementNumber(primitive.element));
}

}  // namespace hl
