#include "session/client_table.h"

#include <utility>

#include "base/clock.h"
#include "session/client_scene.h"

namespace hl {

void ClientTable::start() { running_ = true; }

void ClientTable::stop() {
  {
    const std::lock_guard lock(mutex_);
    running_ = false;
  }
  work_.notify_all();
  changed_.notify_all();
}

std::shared_ptr<ClientScene> ClientTable::join(std::uint32_t session, const SceneLimits& limits,
                                               const MemoryBudget& memory, FrameCallbacks callbacks,
                                               std::shared_ptr<ClientScene> replaced) {
  auto client = std::make_shared<ClientScene>(session, limits, memory, std::move(callbacks));
  client->entry.replaced = std::move(replaced);
  const std::lock_guard lock(mutex_);
  clients_.add(client);
  return client;
}

void ClientTable::submit(const std::shared_ptr<ClientScene>& client, proto::Frame frame, Uploads uploads,
                         MemoryShare memory, bool answers_force) {
  {
    const std::lock_guard lock(mutex_);
    client->entry.waiting.push_back(
        {std::move(frame), std::move(uploads), std::move(memory), answers_force, monotonicNow_ns()});
  }
  work_.notify_one();
}

void ClientTable::place(const std::shared_ptr<ClientScene>& client, PlacedShapes placed, std::int64_t move_ns) {
  const WorldParts bodies = checkBodies(*placed);
  {
    const std::lock_guard lock(mutex_);
    admission_.check(bodies, clients_.partsOfAllBut(*client), client->limits);
    client->entry.placed.swap(placed);  // what was there before is freed without the lock
    client->entry.move_ns = move_ns;
    client->entry.bodies = bodies;
    dirty_ = true;
  }
  changed_.notify_all();
}

std::size_t ClientTable::waiting(const std::shared_ptr<ClientScene>& client) const {
  const std::lock_guard lock(mutex_);
  return client->entry.frames();
}

void ClientTable::detach(const std::shared_ptr<ClientScene>& client) {
  {
    const std::lock_guard lock(mutex_);
    client->entry.waiting.clear();
  }
  client->callbacks.drop();
}

void ClientTable::remove(const std::shared_ptr<ClientScene>& client) {
  const std::lock_guard lock(mutex_);
  client->entry.removed = true;
  dirty_ = true;
  changed_.notify_all();
}

std::shared_ptr<ClientScene> ClientTable::takeReplaced(const std::shared_ptr<ClientScene>& client) {
  const std::lock_guard lock(mutex_);
  return std::exchange(client->entry.replaced, nullptr);
}

void ClientTable::admitBase(const WorldParts& base) {
  const std::lock_guard lock(mutex_);
  admission_.checkBase(base, clients_.partsOfAll());
  admission_.reserve(base);
}

void ClientTable::setBase(const WorldParts& base) {
  const std::lock_guard lock(mutex_);
  admission_.setBase(base);
}

void ClientTable::change() {
  const std::lock_guard lock(mutex_);
  dirty_ = true;
  changed_.notify_all();
}

HierarchyCounts ClientTable::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::optional<BuilderWork> ClientTable::awaitWork() {
  BuilderWork work;
  std::unique_lock lock(mutex_);
  work_.wait(lock, [&] {
    work.client = clients_.withFrame();
    if (!work.client) work.client = clients_.withOutdated();
    return !running_ || work.client;
  });
  if (!running_) return {};
  ClientEntry& entry = work.client->entry;
  if (entry.hasFrame()) {
    work.frame = std::move(entry.waiting.front());
    entry.waiting.pop_front();
  }
  entry.work = work.frame ? ClientEntry::Work::kFrame : ClientEntry::Work::kHierarchies;
  return work;
}

void ClientTable::done(ClientScene& client) {
  const std::lock_guard lock(mutex_);
  client.entry.work = ClientEntry::Work::kNone;
  if (client.entry.removed) dirty_ = true;  // the publisher has left it to this builder
  if (!client.entry.waiting.empty()) work_.notify_one();
  changed_.notify_all();
}

void ClientTable::apply(ClientScene& client, BuiltFrame& frame) {
  PlacedShapes before;
  const std::lock_guard lock(mutex_);  // what was there before is freed without it
  ClientEntry& entry = client.entry;
  admission_.check(frame.bodies, clients_.partsOfAllBut(client), client.limits);
  entry.ready.push_back({frame.number, std::move(frame.decoded.warnings)});
  // From here on nothing throws.
  client.built.scene.show(frame.objects);
  before = std::exchange(entry.placed, client.built.scene.sharedPlaced());
  counts_.refits += frame.decoded.refits;
  entry.outdated = client.built.scene.toRebuild() != nullptr;
  entry.move_ns = frame.move_ns;
  entry.bodies = frame.bodies;
  if (frame.decoded.gravity_m_s2) entry.gravity_m_s2 = {++gravities_, *frame.decoded.gravity_m_s2};
  if (entry.replaced) std::exchange(entry.replaced, nullptr)->entry.removed = true;
  dirty_ = true;
}

void ClientTable::applyRebuilt(ClientScene& client, EditableScene::Next& objects) {
  const std::lock_guard lock(mutex_);
  ++counts_.rebuilds;
  client.built.scene.show(objects);
  client.entry.placed = client.built.scene.sharedPlaced();
  client.entry.outdated = client.built.scene.toRebuild() != nullptr;
  dirty_ = true;
}

void ClientTable::leaveOutdated(ClientScene& client) {
  const std::lock_guard lock(mutex_);
  client.entry.outdated = false;
}

bool ClientTable::awaitChange() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !running_ || dirty_; });
  return running_;
}

SceneParts ClientTable::take() {
  const std::lock_guard lock(mutex_);
  SceneParts parts = clients_.take();
  dirty_ = false;
  return parts;
}

void ClientTable::giveBack(SceneParts& parts) {
  const std::lock_guard lock(mutex_);
  clients_.giveBack(parts.of_clients);
  dirty_ = true;
}

void ClientTable::eraseGone(const SceneParts& shown) {
  const std::lock_guard lock(mutex_);
  clients_.erase(shown.of_clients);
}

ReadyFrame ClientTable::takeReady(ClientScene& client) {
  const std::lock_guard lock(mutex_);
  ReadyFrame frame = std::move(client.entry.ready.front());
  client.entry.ready.pop_front();
  return frame;
}

}  // namespace hl
