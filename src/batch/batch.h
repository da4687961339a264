// Batches: many paths, fingers or points over one scene, on all threads. Each has the same bits as if it were alone: it
// has a state of its own, and what threads share decides nothing but time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.h"
#include "io/csv_path.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl {

/// What a tick came to.
struct BatchRow {
  Vec3 proxy, force_N;
  int contacts = 0;
  double injected_J = 0;
};
/// Receives row `i`; called by several threads at once, once for each row.
using BatchSink = FunctionRef<void(std::size_t i, const BatchRow& row)>;

/// As runTrace() of each path, one after the other; `paths` are views of one list of samples, whose numbers rows have.
void traceBatch(const Snapshot& scene, const ProxySettings& settings, std::span<const PathSample> samples,
                std::span<const std::size_t> ends, int threads, BatchSink sink);

class FingerBatch {
 public:
  FingerBatch(std::shared_ptr<const Snapshot> scene, const ProxySettings& settings, std::size_t fingers)
      : scene_(std::move(scene)), settings_(settings), states_(fingers), begun_(fingers) {}

  std::size_t size() const { return states_.size(); }
  /// One tick of each; by one thread at a time.
  void step(std::span<const Vec3> fingers, int threads, BatchSink sink);
  /// The next step of this one begins a new proxy.
  void reset(std::size_t i) { begun_[i] = 0; }

 private:
  const std::shared_ptr<const Snapshot> scene_;
  const ProxySettings settings_;
  std::vector<ProxyState> states_;
  std::vector<std::uint8_t> begun_;
};

/// The nearest point of the scene at any distance; infinitely far in an empty one.
struct NearestPoint {
  ClosestPoint at;
  PrimitiveId primitive;
};
NearestPoint nearestPoint(const SceneAt& scene, const Vec3& point);
/// Its number among the elements that the model was made with: triangles, then segments, then points; degenerate ones,
/// which cannot be touched, count too.
std::uint64_t numberInModel(const Snapshot& scene, const PrimitiveId& primitive);

}  // namespace hl
