#include "session/scene_publisher.h"

#include <chrono>
#include <string>
#include <utility>

#include "base/guarded_thread.h"
#include "scene/iso_shape.h"
#include "session/client_scene.h"

namespace hl {

namespace {

constexpr auto kLoopPoll = std::chrono::microseconds(200);

std::string jumpWarning(std::size_t meshes) {
  return std::to_string(meshes) +
         " meshes are where they are to be at once: there is no room in the server's memory for what bends them";
}

}  // namespace

ScenePublisher::ScenePublisher(std::shared_ptr<const Snapshot> base, std::vector<TouchSession*> devices,
                               HandGroup* hands)
    : loops_(std::move(devices), hands),
      clients_(partsOf(*base), loops_.devices()),
      base_(std::move(base)),
      next_(base_),
      builders_(clients_) {}

void ScenePublisher::start() {
  clients_.start();
  base_.open();
  builders_.start();
  thread_ = startThread("publisher", [this] { run(); });
}

void ScenePublisher::stop() {
  clients_.stop();
  builders_.join();
  if (thread_.joinable()) thread_.join();
  base_.stop();
}

bool ScenePublisher::replaceBase(const std::shared_ptr<const Snapshot>& base) {
  const std::uint64_t number = base_.replace(base);
  clients_.change();
  return base_.awaitShown(number);
}

void ScenePublisher::setIso(std::uint64_t surface, const IsoChoice& choice) {
  base_.setIso(checkIsoChange(*loops_.snapshot(), surface, choice), choice);
  clients_.change();
}

void ScenePublisher::run() {
  while (clients_.awaitChange()) {
    if (!waitForLoops()) return;
    const bool shown = guarded([this] { publish(); });
    if (!shown) std::this_thread::sleep_for(kAfterFailure);
    if (!waitForLoops()) return;
    loops_.dropSceneBefore();
  }
}

// Until every loop has taken the scene before and lives in the part of its motions that is still known to the next.
bool ScenePublisher::waitForLoops() const {
  while (!loops_.ready(next_.begin_ns())) {
    std::this_thread::sleep_for(kLoopPoll);
    if (!clients_.running()) return false;
  }
  return true;
}

void ScenePublisher::publish() {
  base_.takeNext(next_.number());
  SceneParts parts = clients_.take();
  std::shared_ptr<const Snapshot> scene;
  TouchingLoops::Scenes scenes;
  try {
    scene = next_.make(parts);
    scenes = loops_.prepare(scene);
  } catch (...) {
    clients_.giveBack(parts);
    throw;
  }
  show(scene, std::move(scenes), parts);
  clients_.eraseGone(parts);
  for (const ScenePart& part : parts.of_clients) reportShown(part);
  clients_.wakeBuilder();
}

// To all devices or, had anything failed before, to none.
void ScenePublisher::show(const std::shared_ptr<const Snapshot>& scene, TouchingLoops::Scenes scenes,
                          SceneParts& parts) noexcept {
  loops_.publish(std::move(scenes), base_.other());
  next_.markShown(scene, parts);
  if (base_.other()) base_.markShown();
}

void ScenePublisher::reportShown(const ScenePart& part) {
  ClientScene& client = *part.client;
  std::size_t primitives = 0;
  for (const Instance* instance : client.shown.instances) primitives += instance->shape->elements();
  for (std::size_t i = 0; i < part.frames; ++i) {
    const ReadyFrame frame = clients_.takeReady(client);
    const bool last = i + 1 == part.frames;
    client.callbacks.answer(clients_.running(), [&](const FrameCallbacks& callbacks) {
      std::vector<std::string> warnings = frame.warnings;
      if (last && part.jumps > 0) warnings.push_back(jumpWarning(part.jumps));
      callbacks.shown(frame.number, primitives, warnings);
    });
  }
}

}  // namespace hl
