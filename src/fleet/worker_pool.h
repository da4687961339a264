// The workers of a sweep: processes that each do one task after the other, given to whichever is idle. A worker that
// dies takes with it no more than the task that it had: that one has failed, and another worker goes on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fleet/fleet_result.h"

namespace hl {

struct WorkerProgram {
  std::string file;
  std::vector<std::string> words;  ///< the name first; it then calls answerOrders()
};

/// A task for a worker.
struct FleetOrderText {
  std::string name;
  std::vector<std::string> words;         ///< of the trace
  bool rows = false;                      ///< are kept
  std::string scene_sha256, path_sha256;  ///< of the files that the name of the task stands for
};

struct FleetCallbacks {
  std::function<FleetOrderText(std::size_t task)> order;
  /// The task has come to its end. `failure`: a line that says why there is no result, or empty.
  std::function<void(std::size_t task, const std::string& failure)> done;
  std::function<void()> wait;  ///< called some times a second meanwhile
};

/// Has `jobs` workers do the tasks 0 .. `tasks` - 1. Returns when all are done. The workers die with this process.
/// Throws hl::Error if no worker can be started. From the thread that the program began with.
void runWorkers(const WorkerProgram& program, int jobs, std::size_t tasks, const FleetCallbacks& callbacks);

/// In a worker: does orders from standard input and answers on standard output, until there are no more. `work` throws
/// what is the task's failure. What else is written to standard output goes to standard error.
void answerOrders(const std::function<void(const FleetOrderText& order)>& work);

}  // namespace hl
