#include "sweep_worker.h"

#include <tbb/global_control.h>

#include "base/error.h"
#include "fleet/fleet_plan.h"
#include "fleet/fleet_store.h"
#include "fleet/worker_pool.h"
#include "load_snapshot.h"
#include "trace_options.h"

namespace hl {

namespace {

constexpr const char* kChanged = ": has been changed since the sweep began: run it again";

/// Tasks come with those of one scene, and of one path, after each other: both are kept for the next.
class SweepTasks {
 public:
  explicit SweepTasks(const std::string& folder) : store_(folder) {}

  void work(const FleetOrderText& order) {
    const TraceOptions& options = words_.read(order.words);
    takePath(options.path, order.path_sha256);
    takeScene(options.scene, order.scene_sha256);
    FleetRecorder recorder(order.rows);
    const TraceTotals totals = runTrace(*scene_, options.settings, withTremor(path_, options),
                                        [&](const TraceRow& row) { recorder.add(row); });
    store_.keep(recorder.take(order.name, totals));
  }

 private:
  // What was read must be what the task is named by. So files are read once more after they have been.
  void takePath(const std::string& name, const std::string& sha256) {
    if (path_sha256_ == sha256) return;
    path_sha256_.clear();
    path_ = readPath(name);
    if (pathSource(name).sha256 != sha256) throw Error(name + kChanged);
    path_sha256_ = sha256;
  }
  void takeScene(const SceneOptions& options, const std::string& sha256) {
    if (scene_sha256_ == sha256 && scene_options_ == options) return;
    scene_sha256_.clear();
    scene_.reset();  // there may be no memory for two
    scene_ = loadSnapshot(options);
    if (sceneSource(options.scene).sha256 != sha256) throw Error(options.scene + kChanged);
    scene_options_ = options;
    scene_sha256_ = sha256;
  }

  const FleetStore store_;
  TraceWords words_;
  std::string path_sha256_, scene_sha256_;  // empty: there is none
  std::vector<PathSample> path_;
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
