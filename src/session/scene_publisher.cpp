#include "session/scene_publisher.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <new>
#include <tuple>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/guarded_thread.h"
#include "scene/follow_on.h"
#include "scene/iso_shape.h"
#include "session/check_bodies.h"
#include "session/client_scene.h"
#include "session/kept_lists.h"

namespace hl {

namespace {

// Motion begins a little after the scene is shown, so that every loop has taken it by then.
constexpr std::int64_t kLead_ns = 2'000'000;
constexpr int kLeadTries = 4;
constexpr double kMakingMargin = 1.5;  // of the time that the scene before took to make; doubled with each try
// Between two frames that are farther apart than this, nothing was meant to be seen moving all the time.
constexpr std::int64_t kLongestMove_ns = 100'000'000;
constexpr auto kLoopPoll = std::chrono::microseconds(200);

std::string jumpWarning(std::size_t meshes) {
  return std::to_string(meshes) +
         " meshes are where they are to be at once: there is no room in the server's memory for what bends them";
}

}  // namespace

struct ScenePublisher::Part {
  std::shared_ptr<ClientScene> client;
  bool gone;
  PlacedShapes placed;  // null: as it is
  std::int64_t move_ns;
  std::size_t frames;                  // of the client's ready ones
  std::size_t jumps;                   // Followed::jumps
  std::vector<const Instance*> shown;  // of the client, in the next scene
};

ScenePublisher::ScenePublisher(std::shared_ptr<const Snapshot> base, std::vector<TouchSession*> devices,
                               HandGroup* hands)
    : loops_(std::move(devices), hands), base_parts_(partsOf(*base)), base_(std::move(base)), shown_(base_.now()) {}

ScenePublisher::~ScenePublisher() { stop(); }

void ScenePublisher::start() {
  running_ = true;
  base_.open();
  for (int i = 0; i < kBuilders; ++i) threads_.push_back(startThread("builder", [this] { runBuilder(); }));
  threads_.push_back(startThread("publisher", [this] { runPublisher(); }));
}

void ScenePublisher::stop() {
  {
    const std::lock_guard lock(mutex_);
    running_ = false;
  }
  work_.notify_all();
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  base_.stop();
  threads_.clear();
}

std::shared_ptr<ScenePublisher::ClientScene> ScenePublisher::join(std::uint32_t session, const SceneLimits& limits,
                                                                  MemoryBudget memory, FrameCallbacks callbacks,
                                                                  std::shared_ptr<ClientScene> replaced) {
  auto client =
      std::make_shared<ClientScene>(session, limits, std::move(memory), std::move(callbacks), std::move(replaced));
  const std::lock_guard lock(mutex_);
  clients_.push_back(client);
  return client;
}

void ScenePublisher::submit(const std::shared_ptr<ClientScene>& client, proto::Frame frame, Uploads uploads,
                            MemoryShare memory, bool answers_force) {
  {
    const std::lock_guard lock(mutex_);
    client->waiting_.push_back(
        {std::move(frame), std::move(uploads), std::move(memory), answers_force, monotonicNow_ns()});
  }
  work_.notify_one();
}

void ScenePublisher::place(const std::shared_ptr<ClientScene>& client, PlacedShapes placed, std::int64_t move_ns) {
  const WorldParts bodies = checkBodies(*placed);
  {
    const std::lock_guard lock(mutex_);
    admitBodies(*client, bodies);
    client->placed_.swap(placed);  // what was there before is freed without the lock
    client->pace_.move_ns = move_ns;
    client->bodies_.parts = bodies;
    dirty_ = true;
  }
  changed_.notify_all();
}

std::size_t ScenePublisher::waiting(const std::shared_ptr<ClientScene>& client) const {
  const std::lock_guard lock(mutex_);
  return client->waiting_.size() + (client->work_ == ClientScene::Work::kFrame ? 1 : 0) + client->ready_.size();
}

HierarchyCounts ScenePublisher::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void ScenePublisher::detach(const std::shared_ptr<ClientScene>& client) {
  {
    const std::lock_guard lock(mutex_);
    client->waiting_.clear();
  }
  const std::lock_guard lock(client->call_mutex_);
  client->callbacks_ = {};
}

void ScenePublisher::remove(const std::shared_ptr<ClientScene>& client) {
  const std::lock_guard lock(mutex_);
  client->removed_ = true;
  dirty_ = true;
  changed_.notify_all();
}

std::shared_ptr<ScenePublisher::ClientScene> ScenePublisher::takeReplaced(const std::shared_ptr<ClientScene>& client) {
  const std::lock_guard lock(mutex_);
  return std::exchange(client->replaced_, nullptr);
}

bool ScenePublisher::replaceBase(const std::shared_ptr<const Snapshot>& base) {
  const WorldParts parts = partsOf(*base);
  {
    const std::lock_guard lock(mutex_);
    admit(parts);
    base_parts_ = parts;
  }
  const std::uint64_t number = base_.replace(base);
  {
    const std::lock_guard lock(mutex_);
    dirty_ = true;
  }
  changed_.notify_all();
  return base_.awaitShown(number);
}

void ScenePublisher::admitBase(const Snapshot& base) const {
  const WorldParts parts = partsOf(base);
  const std::lock_guard lock(mutex_);
  admit(parts);
}

// Holding the mutex.
void ScenePublisher::admit(const WorldParts& base) const {
  WorldParts all = partsOfAllBut(nullptr);
  all += base;
  if (all.bodies > 0) checkBodiesOfAll(all, {kMaxBodies, kMaxJoints}, loops_.devices());
}

void ScenePublisher::setIso(std::uint64_t surface, const IsoChoice& choice) {
  base_.setIso(checkIsoChange(*loops_.snapshot(), surface, choice), choice);
  const std::lock_guard lock(mutex_);
  dirty_ = true;
  changed_.notify_all();
}

// The client that has waited longest. Holding the mutex.
std::shared_ptr<ScenePublisher::ClientScene> ScenePublisher::sceneToBuild() {
  std::shared_ptr<ClientScene> oldest;
  for (const auto& client : clients_) {
    if (client->work_ != ClientScene::Work::kNone || client->removed_ || client->waiting_.empty()) continue;
    if (!oldest || client->waiting_.front().arrived_ns < oldest->waiting_.front().arrived_ns) oldest = client;
  }
  return oldest;
}

// Only when no frame waits, and one at a time: the other builders are for frames. Holding the mutex.
std::shared_ptr<ScenePublisher::ClientScene> ScenePublisher::sceneToRebuild() {
  std::shared_ptr<ClientScene> outdated;
  for (const auto& client : clients_) {
    if (client->work_ == ClientScene::Work::kHierarchies) return nullptr;
    const bool idle = client->work_ == ClientScene::Work::kNone && !client->removed_ && client->waiting_.empty();
    const bool shown = !client->placed_ && client->ready_.empty();
    if (client->to_rebuild_ && idle && shown && !outdated) outdated = client;
  }
  return outdated;
}

void ScenePublisher::runBuilder() {
  std::unique_lock lock(mutex_);
  while (true) {
    std::shared_ptr<ClientScene> client;
    bool frame = false;
    work_.wait(lock, [&] {
      client = sceneToBuild();
      frame = client != nullptr;
      if (!frame) client = sceneToRebuild();
      return !running_ || client;
    });
    if (!running_) return;
    client->work_ = frame ? ClientScene::Work::kFrame : ClientScene::Work::kHierarchies;
    Waiting waiting;
    if (frame) {
      waiting = std::move(client->waiting_.front());
      client->waiting_.pop_front();
    }
    lock.unlock();
    guarded([&] { frame ? build(*client, std::move(waiting)) : rebuild(*client); });
    lock.lock();
    client->work_ = ClientScene::Work::kNone;
    if (client->removed_) dirty_ = true;  // the publisher has left it to this builder
    if (!client->waiting_.empty()) work_.notify_one();
    changed_.notify_all();
  }
}

// A frame that cannot be shown changes nothing; its client gets the reason. Its messages go with it, before anyone is
// locked out.
void ScenePublisher::build(ClientScene& client, Waiting waiting) {
  const std::uint64_t number = waiting.frame.number();
  const auto progress = [&](double part) {
    if (!running_) throw Error("the server is closing");
    client.callBack([&](FrameCallbacks& callbacks) { callbacks.progress(number, part); });
  };
  try {
    DecodedFrame decoded = decodeFrame(waiting.frame, waiting.uploads, client.limits_, client.memory_, progress,
                                       [&](std::uint32_t object) { return client.scene_.items(object); });
    decoded.edit.answers_force = waiting.answers_force;
    EditableScene::Next next = client.scene_.prepare(std::move(decoded.edit));
    const WorldParts bodies = checkBodies(next.placed());
    for (std::string& warning : warningsOfNewBodies(next.placed(), client.scene_.placed()))
      decoded.warnings.push_back(std::move(warning));
    PlacedShapes before;
    const std::lock_guard lock(mutex_);  // what was there before is freed without it
    admitBodies(client, bodies);
    client.ready_.push_back({number, std::move(decoded.warnings)});
    // From here on nothing throws.
    client.scene_.show(next);
    before = std::exchange(client.placed_, client.scene_.sharedPlaced());
    counts_.refits += decoded.refits;
    client.to_rebuild_ = client.scene_.toRebuild() != nullptr;
    client.pace_.move_ns = moveTime_ns(waiting, client.pace_.last_arrived_ns);
    client.pace_.last_arrived_ns = waiting.arrived_ns;
    client.bodies_.parts = bodies;
    if (decoded.gravity_m_s2) client.bodies_.gravity = {++gravities_, *decoded.gravity_m_s2};
    if (client.replaced_) std::exchange(client.replaced_, nullptr)->removed_ = true;
    dirty_ = true;
  } catch (const std::bad_alloc&) {
    return refuse(client, number, "the server has no memory for it");
  } catch (const std::exception& error) {
    return refuse(client, number, error.what());
  }
}

// Of all clients but this one and the one that it replaces. Holding the mutex.
WorldParts ScenePublisher::partsOfAllBut(const ClientScene* client) const {
  WorldParts all;
  for (const auto& other : clients_) {
    const bool replaced = client != nullptr && other == client->replaced_;
    if (other.get() != client && !other->removed_ && !replaced) all += other->bodies_.parts;
  }
  return all;
}

// Holding the mutex.
void ScenePublisher::admitBodies(ClientScene& client, const WorldParts& parts) const {
  WorldParts all = partsOfAllBut(&client);
  all += base_parts_;
  all += parts;
  if (parts.bodies > 0) checkBodiesOfAll(all, {client.limits_.bodies, client.limits_.joints}, loops_.devices());
}

// A client gets the answer that it waits for in the end, however short memory is meanwhile.
void ScenePublisher::answer(FunctionRef<void()> call) {
  keepTrying([this] { return running_.load(); }, call);
}

void ScenePublisher::refuse(ClientScene& client, std::uint64_t number, const char* why) {
  answer([&] { client.callBack([&](FrameCallbacks& callbacks) { callbacks.refused(number, why); }); });
}

// One hierarchy, so that a frame that comes meanwhile waits for no more. Nothing is felt of it: the geometry is the
// same.
void ScenePublisher::rebuild(ClientScene& client) {
  try {
    const auto outdated = client.scene_.toRebuild();
    const auto anew = makeCounted(client.memory_, bytesToMake(outdated->model), [&] { return rebuilt(*outdated); });
    EditableScene::Next next = client.scene_.prepareReplaced(outdated, anew);
    const std::lock_guard lock(mutex_);
    ++counts_.rebuilds;
    client.scene_.show(next);
    client.placed_ = client.scene_.sharedPlaced();
    client.to_rebuild_ = client.scene_.toRebuild() != nullptr;
    dirty_ = true;
  } catch (const std::exception&) {  // no memory for it: the outdated one serves
    const std::lock_guard lock(mutex_);
    client.to_rebuild_ = false;
  }
}

// What the client asks for, or else the time since its last frame.
std::int64_t ScenePublisher::moveTime_ns(const Waiting& waiting, std::int64_t last_arrived_ns) {
  const double wanted_ns = waiting.frame.has_interval_s() ? 1e9 * waiting.frame.interval_s()
                                                          : static_cast<double>(waiting.arrived_ns - last_arrived_ns);
  if (!(wanted_ns > 0)) return 0;
  return static_cast<std::int64_t>(std::min(wanted_ns, static_cast<double>(kLongestMove_ns)));
}

void ScenePublisher::runPublisher() {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return !running_ || dirty_; });
      if (!running_) return;
    }
    if (!waitForLoops()) return;
    const bool shown = guarded([this] { publish(); });
    if (!shown) std::this_thread::sleep_for(kAfterFailure);
    if (!waitForLoops()) return;
    loops_.dropSceneBefore();
  }
}

// Until every loop has taken the scene before and lives in the part of its motions that is still known to the next.
bool ScenePublisher::waitForLoops() {
  while (!loops_.ready(shown_begin_ns_)) {
    std::this_thread::sleep_for(kLoopPoll);
    const std::lock_guard lock(mutex_);
    if (!running_) return false;
  }
  return true;
}

std::vector<ScenePublisher::Part> ScenePublisher::takeParts() {
  const std::lock_guard lock(mutex_);
  std::vector<Part> parts;
  parts.reserve(clients_.size());  // from here on nothing is thrown
  for (const auto& client : clients_)
    parts.push_back({client,
                     client->removed_,
                     std::exchange(client->placed_, nullptr),
                     client->pace_.move_ns,
                     client->ready_.size(),
                     0,
                     {}});
  dirty_ = false;
  gravity_m_s2_.reset();
  std::uint64_t newest = 0;
  for (const auto& client : clients_) {
    if (client->removed_ || client->bodies_.gravity.first <= newest) continue;
    std::tie(newest, gravity_m_s2_) = client->bodies_.gravity;
  }
  return parts;
}

// They could not be shown: the next time, unless there is something newer by then.
void ScenePublisher::giveBack(std::vector<Part>& parts) {
  const std::lock_guard lock(mutex_);
  for (Part& part : parts) {
    if (!part.client->placed_) part.client->placed_ = std::move(part.placed);
  }
  dirty_ = true;
}

// What all clients have in the world from `begin_ns` on; returns Snapshot::blend_ns.
std::int64_t ScenePublisher::assemble(std::vector<Part>& parts, std::int64_t begin_ns,
                                      std::vector<Instance>& instances) const {
  std::int64_t blend_ns = 0;
  std::size_t count = base_.now()->instances.size();
  for (const Part& part : parts) count += part.placed ? part.placed->size() : part.client->shown_.instances.size();
  instances.reserve(count);
  base_.appendTo(instances);
  if (base_.other() || base_.lastReplaced() > shown_->number) blend_ns = kAbruptBlend_ns;
  for (auto& [client, gone, placed, move_ns, frames, jumps, shown] : parts) {
    if (gone) {
      if (!client->shown_.instances.empty()) blend_ns = std::max(blend_ns, kAbruptBlend_ns);
    } else if (placed) {
      Followed next = followOn(*placed, client->shown_.instances, begin_ns, begin_ns + move_ns, client->memory_,
                               boundsForBodies(*base_.now(), *placed), shown_->number + 1);
      jumps = next.jumps;
      blend_ns = std::max(blend_ns, next.blend_ns);
      std::move(next.instances.begin(), next.instances.end(), std::back_inserter(instances));
    } else {
      for (const Instance* instance : client->shown_.instances) {
        instances.push_back(*instance);
        if (instance->mesh_motion && instance->mesh_motion->end_ns() <= begin_ns) instances.back().mesh_motion.reset();
      }
    }
  }
  return blend_ns;
}

// Made before its motions begin: if it takes too long for that, once more.
std::shared_ptr<const Snapshot> ScenePublisher::makeNext(std::vector<Part>& parts) {
  std::shared_ptr<const Snapshot> next;
  std::vector<PlacedShapes> lists;
  for (const Part& part : parts) {
    if (!part.gone) lists.push_back(part.placed ? part.placed : part.client->shown_.placed);
  }
  Mechanics mechanics = base_.mechanics();
  if (gravity_m_s2_) mechanics.gravity_m_s2 = *gravity_m_s2_;
  addJoints(lists, mechanics);
  double margin = kMakingMargin;
  for (int i = 0; i < kLeadTries; ++i, margin *= 2) {
    next.reset();
    const std::int64_t now_ns = monotonicNow_ns();
    shown_begin_ns_ = now_ns + kLead_ns + static_cast<std::int64_t>(margin * static_cast<double>(making_ns_));
    std::vector<Instance> instances;
    const std::int64_t blend_ns = assemble(parts, shown_begin_ns_, instances);
    next = makeSnapshot(std::move(instances), base_.now()->name, shown_->number + 1, blend_ns, mechanics);
    making_ns_ = monotonicNow_ns() - now_ns;
    if (now_ns + making_ns_ < shown_begin_ns_) break;
  }
  return keeping(std::move(lists), std::move(next));
}

void ScenePublisher::publish() {
  base_.takeNext(shown_->number + 1);
  std::vector<Part> parts = takeParts();
  std::shared_ptr<const Snapshot> next;
  TouchingLoops::Scenes scenes;
  try {
    next = makeNext(parts);
    listShown(*next, parts);
    scenes = loops_.prepare(next);
  } catch (...) {
    giveBack(parts);
    throw;
  }
  show(next, std::move(scenes), parts);
  for (const Part& part : parts) reportShown(part);
  work_.notify_one();  // what is outdated may be rebuilt now
}

// For each client what of the scene is its own.
void ScenePublisher::listShown(const Snapshot& next, std::vector<Part>& parts) {
  std::map<std::uint32_t, Part*> part_of;
  for (Part& part : parts) part_of[part.client->session_] = &part;
  for (const Instance& instance : next.instances) {
    const auto found = part_of.find(instance.session);
    if (found != part_of.end()) found->second->shown.push_back(&instance);
  }
}

// To all devices or, had anything failed before, to none.
void ScenePublisher::show(const std::shared_ptr<const Snapshot>& next, TouchingLoops::Scenes scenes,
                          std::vector<Part>& parts) noexcept {
  loops_.publish(std::move(scenes), base_.other());
  for (Part& part : parts) {
    part.client->shown_.instances.swap(part.shown);
    if (part.placed) part.client->shown_.placed = part.placed;
    if (part.gone) part.client->shown_.placed = nullptr;
  }
  shown_ = next;
  if (base_.other()) base_.markShown();
}

void ScenePublisher::reportShown(const Part& part) {
  ClientScene& client = *part.client;
  std::size_t primitives = 0;
  for (const Instance* instance : client.shown_.instances) primitives += instance->shape->elements();
  {
    const std::lock_guard lock(mutex_);
    if (part.gone && client.work_ == ClientScene::Work::kNone) std::erase(clients_, part.client);
  }
  for (std::size_t i = 0; i < part.frames; ++i) {
    std::unique_lock lock(mutex_);
    const ClientScene::Ready frame = std::move(client.ready_.front());
    client.ready_.pop_front();
    lock.unlock();
    const bool last = i + 1 == part.frames;
    answer([&] {
      std::vector<std::string> warnings = frame.warnings;
      if (last && part.jumps > 0) warnings.push_back(jumpWarning(part.jumps));
      client.callBack([&](FrameCallbacks& callbacks) { callbacks.shown(frame.number, primitives, warnings); });
    });
  }
}

}  // namespace hl
