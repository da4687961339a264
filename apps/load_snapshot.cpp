#include "load_snapshot.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/error.h"
#include "base/machine_memory.h"
#include "base/utf8.h"
#include "io/load_scene.h"
#include "scene_report.h"
#include "standard_streams.h"

namespace hl {

namespace {

// A line that rewrites itself, on terminals only.
void showProgress(double fraction) {
  if (isatty(STDERR_FILENO) == 0) return;
  tell("\rreading: {:3.0f} %", 100 * fraction);
  if (fraction >= 1) tell("\r              \r");
  std::fflush(stderr);
}

void requireCad(const Snapshot& snapshot, const std::string& name) {
  for (const Instance& instance : snapshot.instances) {
    if (instance.shape->model.reading.cad) return;
  }
  throw Error(name + ": there is no CAD file in it, which could have a deflection");
}

}  // namespace

void requireMemory(const SceneModel& scene, const std::string& name, std::uint64_t there_bytes) {
  const std::uint64_t needed = bytesToMake(scene);
  if (needed > there_bytes)
    throw Error(fmt::format("{}: this scene takes {:.1f} GB of memory, and there are {:.1f} GB", name,
                            1e-9 * static_cast<double>(needed), 1e-9 * static_cast<double>(there_bytes)));
}

std::shared_ptr<const Snapshot> loadSnapshot(const SceneOptions& options, LaterFiles later) {
  LoadOptions load;
  load.progress = showProgress;
  load.cad = options.cad;
  load.grid = options.grid;
  SceneModel scene = loadScene(options.scene, load);
  if (options.solid) setSolidSide(scene, *options.solid);
  if (!options.iso.empty()) setIsoValues(scene, options.iso);  // a value may have a surface on one side only
  if (options.surfels) setSurfels(scene, options.surfel_reach);
  if (options.vertical_scale) scaleHeights(scene, *options.vertical_scale);
  if (options.scale) scaleModel(scene, *options.scale);
  if (options.fit) fitModel(scene, *options.fit);
  requireMemory(scene, options.scene, machineMemory_bytes());
  auto snapshot = makeSnapshot(std::move(scene), options.hierarchy);
  if (later == LaterFiles::kNone && !(options.cad == CadMeshing{})) requireCad(*snapshot, options.scene);
  const std::string file = options.scene + ":";  // which those of a scene file begin with, and a line
  for (const std::string& warning : warningsOf(*snapshot))
    tell("{}\n", printable(warning.starts_with(file) ? warning : file + " " + warning));
  if (snapshot->primitives == 0) throw Error(options.scene + ": nothing in it can be touched");
  return snapshot;
}

}  // namespace hl
