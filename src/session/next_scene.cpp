#include "session/next_scene.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "base/clock.h"
#include "scene/follow_on.h"
#include "session/check_bodies.h"
#include "session/client_scene.h"
#include "session/kept_lists.h"

namespace hl {

namespace {

// Motion begins a little after the scene is shown, so that every loop has taken it by then.
constexpr std::int64_t kLead_ns = 2'000'000;
constexpr int kLeadTries = 4;
constexpr double kMakingMargin = 1.5;  // of the time that the scene before took to make; doubled with each try

std::vector<PlacedShapes> listsOf(const std::vector<ScenePart>& parts) {
  std::vector<PlacedShapes> lists;
  for (const ScenePart& part : parts) {
    if (!part.gone) lists.push_back(part.placed ? part.placed : part.client->shown.placed);
  }
  return lists;
}

// For each client what of the scene is its own.
void listShown(const Snapshot& next, std::vector<ScenePart>& parts) {
  std::map<std::uint32_t, ScenePart*> part_of;
  for (ScenePart& part : parts) part_of[part.client->session] = &part;
  for (const Instance& instance : next.instances) {
    const auto found = part_of.find(instance.session);
    if (found != part_of.end()) found->second->shown.push_back(&instance);
  }
}

}  // namespace

// If it takes too long for its motions to begin afterwards, once more.
std::shared_ptr<const Snapshot> NextScene::make(SceneParts& parts) {
  std::shared_ptr<const Snapshot> next;
  std::vector<PlacedShapes> lists = listsOf(parts.of_clients);
  const Mechanics mechanics = mechanicsOf(lists, parts);
  double margin = kMakingMargin;
  for (int i = 0; i < kLeadTries; ++i, margin *= 2) {
    next.reset();
    const std::int64_t now_ns = monotonicNow_ns();
    begin_ns_ = now_ns + kLead_ns + static_cast<std::int64_t>(margin * static_cast<double>(making_ns_));
    std::vector<Instance> instances;
    const std::int64_t blend_ns = assemble(parts.of_clients, instances);
    next = makeSnapshot(std::move(instances), base_.now()->name, number(), blend_ns, mechanics);
    making_ns_ = monotonicNow_ns() - now_ns;
    if (now_ns + making_ns_ < begin_ns_) break;
  }
  next = keeping(std::move(lists), std::move(next));
  listShown(*next, parts.of_clients);
  return next;
}

Mechanics NextScene::mechanicsOf(const std::vector<PlacedShapes>& lists, const SceneParts& parts) const {
  Mechanics mechanics = base_.mechanics();
  if (parts.gravity_m_s2) mechanics.gravity_m_s2 = *parts.gravity_m_s2;
  addJoints(lists, mechanics);
  return mechanics;
}

// What all have in the world from begin_ns() on; returns Snapshot::blend_ns.
std::int64_t NextScene::assemble(std::vector<ScenePart>& parts, std::vector<Instance>& instances) const {
  std::size_t count = base_.now()->instances.size();
  for (const ScenePart& part : parts) count += part.placed ? part.placed->size() : part.client->shown.instances.size();
  instances.reserve(count);
  base_.appendTo(instances);
  const bool abrupt = base_.other() || base_.lastReplaced() > shown_->number;
  std::int64_t blend_ns = abrupt ? kAbruptBlend_ns : 0;
  for (ScenePart& part : parts) {
    if (part.gone) {
      if (!part.client->shown.instances.empty()) blend_ns = std::max(blend_ns, kAbruptBlend_ns);
    } else if (part.placed) {
      blend_ns = std::max(blend_ns, follow(part, instances));
    } else {
      keepShown(*part.client, instances);
    }
  }
  return blend_ns;
}

// A client's new objects, on their way from those that are shown; returns Followed::blend_ns.
std::int64_t NextScene::follow(ScenePart& part, std::vector<Instance>& instances) const {
  const ClientScene& client = *part.client;
  Followed next = followOn(*part.placed, client.shown.instances, begin_ns_, begin_ns_ + part.move_ns, client.memory,
                           boundsForBodies(*base_.now(), *part.placed), number());
  part.jumps = next.jumps;
  std::move(next.instances.begin(), next.instances.end(), std::back_inserter(instances));
  return next.blend_ns;
}

void NextScene::keepShown(const ClientScene& client, std::vector<Instance>& instances) const {
  for (const Instance* instance : client.shown.instances) {
    instances.push_back(*instance);
    if (instance->mesh_motion && instance->mesh_motion->end_ns() <= begin_ns_) instances.back().mesh_motion.reset();
  }
}

void NextScene::markShown(const std::shared_ptr<const Snapshot>& scene, SceneParts& parts) noexcept {
  for (ScenePart& part : parts.of_clients) {
    ShownObjects& shown = part.client->shown;
    shown.instances.swap(part.shown);
    if (part.placed) shown.placed = part.placed;
    if (part.gone) shown.placed = nullptr;
  }
  shown_ = scene;
}

}  // namespace hl
