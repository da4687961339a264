#include "file_opener.h"

#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"
#include "io/load_scene_file.h"
#include "io/load_sent.h"
#include "load_snapshot.h"
#include "monitor/event_log.h"
#include "scene_report.h"
#include "standard_streams.h"
#include "surfaces/point_cloud.h"

namespace hl {

namespace {

constexpr std::size_t kMaxWarnings = 5;  // that a page is sent

std::string answerOf(const Snapshot& scene, std::span<const std::string> given, double world_per_device) {
  // A surfel is four triangles: the user has given one point.
  std::uint64_t triangles = 0, segments = 0, points = 0, primitives = scene.primitives;
  for (const Instance& instance : scene.instances) {
    if (const auto* cloud = dynamic_cast<const PointCloud*>(instance.shape->source.get()); cloud != nullptr) {
      points += cloud->points()->size();
      primitives -= instance.shape->elements() - cloud->points()->size();
    } else {
      triangles += trianglesOf(*instance.shape);
      segments += instance.shape->model.segments.size();
      points += instance.shape->model.points.size();
    }
  }
  std::string warnings;
  for (std::size_t i = 0; i < std::min(given.size(), kMaxWarnings); ++i)
    warnings += (i > 0 ? "," : "") + jsonString(printable(given[i]));
  return fmt::format(
      R"({{"name":{},"triangles":{},"segments":{},"points":{},"primitives":{},"world_per_device":{:.6g},"warnings":[{}]}})",
      jsonString(printable(scene.name)), triangles, segments, points, primitives, world_per_device, warnings);
}

// How a bare model is shaded, and a scene file by itself, where the user has not said it.
void shade(TouchSession& session, bool smooth) {
  MaterialOverride surfaces = session.live().surfaces();
  surfaces.smooth.reset();
  if (smooth) surfaces.smooth = true;
  session.live().setSurfaces(surfaces);
}

}  // namespace

// What it may give is what the server has room for.
SceneModel FileOpener::read(int descriptor, const std::string& name) const {
  const MemoryBudget& memory = touch_.memory();
  const std::uint64_t left = memory.most_bytes() - std::min(memory.used_bytes(), memory.most_bytes());
  IsolationLimits limits;
  limits.memory_bytes = std::min<std::uint64_t>(limits.memory_bytes, left);
  SceneModel scene = loadSent(descriptor, name, {"/proc/self/exe", {"hl", kReadSent}}, limits, given_up_, cad_);
  requireMemory(scene, name, left);
  return scene;
}

std::string FileOpener::open(int descriptor, const std::string& name) {
  const std::shared_ptr<const Snapshot> scene = makeSnapshot(read(descriptor, name), hierarchy_);
  if (scene->primitives == 0) throw Error(name + ": nothing in it can be touched");
  if (given_up_) throw Error("the server is closing");
  touch_.replaceScene(scene);
  TouchSession& session = touch_.device();
  if (smooth_) shade(session, !isSceneFile("scene" + sentEndingOf(name)));
  const double scale = session.live().workspace().world_per_device;
  tell("{}: {}; 1 mm of the hand is {:.4g} mm of the scene\n", printable(name), counted(scene->primitives, "primitive"),
       scale);
  const std::vector<std::string> warnings = warningsOf(*scene);
  for (const std::string& warning : warnings) tell("{}: {}\n", printable(name), printable(warning));
  return answerOf(*scene, warnings, scale);
}

}  // namespace hl
