#include "session/frame_builders.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "base/error.h"
#include "base/guarded_thread.h"
#include "session/client_scene.h"

namespace hl {

namespace {

// Between two frames that are farther apart than this, nothing was meant to be seen moving all the time.
constexpr std::int64_t kLongestMove_ns = 100'000'000;

// What the client asks for, or else the time since its last frame.
std::int64_t moveTime_ns(const WaitingFrame& waiting, std::int64_t last_arrived_ns) {
  const double wanted_ns = waiting.frame.has_interval_s() ? 1e9 * waiting.frame.interval_s()
                                                          : static_cast<double>(waiting.arrived_ns - last_arrived_ns);
  if (!(wanted_ns > 0)) return 0;
  return static_cast<std::int64_t>(std::min(wanted_ns, static_cast<double>(kLongestMove_ns)));
}

}  // namespace

void FrameBuilders::start() {
  for (int i = 0; i < kThreads; ++i) threads_.push_back(startThread("builder", [this] { run(); }));
}

void FrameBuilders::join() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void FrameBuilders::run() {
  while (std::optional<BuilderWork> work = clients_.awaitWork()) {
    ClientScene& client = *work->client;
    guarded([&] { work->frame ? build(client, std::move(*work->frame)) : rebuild(client); });
    clients_.done(client);
  }
}

// A frame that cannot be shown changes nothing; its client gets the reason. Its messages go with it, before the client
// is done.
void FrameBuilders::build(ClientScene& client, WaitingFrame waiting) {
  const std::uint64_t number = waiting.frame.number();
  try {
    BuiltFrame frame = built(client, waiting);
    clients_.apply(client, frame);
    client.built.last_arrived_ns = waiting.arrived_ns;
  } catch (const std::bad_alloc&) {
    refuse(client, number, "the server has no memory for it");
  } catch (const std::exception& error) {
    refuse(client, number, error.what());
  }
}

BuiltFrame FrameBuilders::built(ClientScene& client, WaitingFrame& waiting) const {
  const std::uint64_t number = waiting.frame.number();
  EditableScene& scene = client.built.scene;
  const auto progress = [&](double part) {
    if (!clients_.running()) throw Error("the server is closing");
    client.callbacks.call([&](const FrameCallbacks& callbacks) { callbacks.progress(number, part); });
  };
  DecodedFrame decoded = decodeFrame(waiting.frame, waiting.uploads, client.limits, client.memory, progress,
                                     [&](std::uint32_t object) { return scene.items(object); });
  decoded.edit.answers_force = waiting.answers_force;
  EditableScene::Next next = scene.prepare(std::move(decoded.edit));
  const WorldParts bodies = checkBodies(next.placed());
  for (std::string& warning : warningsOfNewBodies(next.placed(), scene.placed()))
    decoded.warnings.push_back(std::move(warning));
  return {number, std::move(decoded), std::move(next), bodies, moveTime_ns(waiting, client.built.last_arrived_ns)};
}

void FrameBuilders::refuse(ClientScene& client, std::uint64_t number, const char* why) {
  client.callbacks.answer(clients_.running(), [&](const FrameCallbacks& callbacks) { callbacks.refused(number, why); });
}

// One hierarchy, so that a frame that comes meanwhile waits for no more. Nothing is felt of it: the geometry is the
// same.
void FrameBuilders::rebuild(ClientScene& client) {
  try {
    EditableScene& scene = client.built.scene;
    const auto outdated = scene.toRebuild();
    const auto anew = makeCounted(client.memory, bytesToMake(outdated->model), [&] { return rebuilt(*outdated); });
    EditableScene::Next next = scene.prepareReplaced(outdated, anew);
    clients_.applyRebuilt(client, next);
  } catch (const std::exception&) {
    clients_.leaveOutdated(client);
  }
}

}  // namespace hl
