#include "sweep_worker.h"

#include <tbb/global_control.h>

#include <optional>

#include "base/error.h"
#include "fleet/fleet_store.h"
#include "fleet/worker_pool.h"
#include "trace_options.h"

namespace hl {

namespace {

/// Tasks come with those of one scene after each other: it is kept for the next.
class SweepTasks {
 public:
  explicit SweepTasks(const std::string& folder) : store_(folder) {}

  void work(const FleetOrderText& order) {
    const TraceOptions& options = words_.read(order.words);
    const std::vector<PathSample> path = pathOf(options);
    if (!scene_ || !(scene_options_ == options.scene)) {
      scene_.reset();
      scene_ = loadSnapshot(options.scene);
      scene_options_ = options.scene;
    }
    FleetRecorder recorder(order.rows);
    const TraceTotals totals =
        runTrace(*scene_, options.settings, path, [&](const TraceRow& row) { recorder.add(row); });
    store_.keep(recorder.take(order.name, totals));
  }

 private:
  const FleetStore store_;
  TraceWords words_;
  SceneOptions scene_options_;
  std::shared_ptr<const Snapshot> scene_;
};

}  // namespace

int runSweepWorker(const std::string& folder) {
  // The workers are what runs side by side. And model files are read in a process that is forked: without threads.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  SweepTasks tasks(folder);
  answerOrders([&](const FleetOrderText& order) { tasks.work(order); });
  return 0;
}

}  // namespace hl
