#include "session/client_list.h"

#include <tuple>
#include <utility>

#include "session/client_scene.h"

namespace hl {

void ClientList::erase(const std::vector<ScenePart>& gone) {
  for (const ScenePart& part : gone) {
    if (part.gone && part.client->entry.work == ClientEntry::Work::kNone) std::erase(clients_, part.client);
  }
}

std::shared_ptr<ClientScene> ClientList::withFrame() const {
  std::shared_ptr<ClientScene> oldest;
  for (const auto& client : clients_) {
    if (!client->entry.hasFrame()) continue;
    if (!oldest || client->entry.waiting.front().arrived_ns < oldest->entry.waiting.front().arrived_ns) oldest = client;
  }
  return oldest;
}

std::shared_ptr<ClientScene> ClientList::withOutdated() const {
  std::shared_ptr<ClientScene> outdated;
  for (const auto& client : clients_) {
    if (client->entry.work == ClientEntry::Work::kHierarchies) return nullptr;
    if (client->entry.mayRebuild() && !outdated) outdated = client;
  }
  return outdated;
}

WorldParts ClientList::partsOfAll() const {
  WorldParts all;
  for (const auto& client : clients_) {
    if (!client->entry.removed) all += client->entry.bodies;
  }
  return all;
}

WorldParts ClientList::partsOfAllBut(const ClientScene& client) const {
  WorldParts all;
  for (const auto& other : clients_) {
    if (other.get() == &client || other == client.entry.replaced) continue;
    if (!other->entry.removed) all += other->entry.bodies;
  }
  return all;
}

SceneParts ClientList::take() {
  SceneParts parts;
  parts.of_clients.reserve(clients_.size());  // from here on nothing is thrown
  for (const auto& client : clients_) {
    ClientEntry& entry = client->entry;
    parts.of_clients.push_back(
        {client, entry.removed, std::exchange(entry.placed, nullptr), entry.move_ns, entry.ready.size(), 0, {}});
  }
  parts.gravity_m_s2 = newestGravity_m_s2();
  return parts;
}

std::optional<Vec3> ClientList::newestGravity_m_s2() const {
  std::optional<Vec3> gravity_m_s2;
  std::uint64_t newest = 0;
  for (const auto& client : clients_) {
    if (client->entry.removed || client->entry.gravity_m_s2.first <= newest) continue;
    std::tie(newest, gravity_m_s2) = client->entry.gravity_m_s2;
  }
  return gravity_m_s2;
}

void ClientList::giveBack(std::vector<ScenePart>& parts) {
  for (ScenePart& part : parts) {
    if (!part.client->entry.placed) part.client->entry.placed = std::move(part.placed);
  }
}

}  // namespace hl
