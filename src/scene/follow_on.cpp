#include "scene/follow_on.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/by_key.h"
#include "scene/follow_body.h"
#include "scene/scene_limits.h"

namespace hl {

namespace {

// Whether `now` is the object `before`, possibly with a deformed mesh; then the mesh changes by a transition.
bool isDeformed(const Instance& before, const PlacedShape& now) {
  return before.shape->mesh == now.shape->mesh &&
         before.shape->model.materials.size() <= now.surfaces->materials.size();
}

template <typename List>
bool same(const std::shared_ptr<const List>& a, const std::shared_ptr<const List>& b) {
  return a == b || (a && b && *a == *b);
}

// Contribution of one object to Snapshot::blend_ns. `before`: the object in the last snapshot; null: none.
std::int64_t blendOf(const Instance* before, const Instance& now, const PlacedShape& placed) {
  if (before == nullptr || !(*before->surfaces == *now.surfaces)) return kAbruptBlend_ns;
  if (!same(before->snaps, now.snaps)) return kAbruptBlend_ns;
  if (before->movesAsBody() != now.movesAsBody()) return kAbruptBlend_ns;
  if (now.movesAsBody() && before->shape->model.positions != now.shape->model.positions) return kAbruptBlend_ns;
  if (!now.motion.moves() && !(before->motion.to() == now.motion.to())) return kAbruptBlend_ns;
  return before->shape->geometry == now.shape->geometry || isDeformed(*before, placed) ? 0 : kAbruptBlend_ns;
}

// A transition that has ended is dropped, and with it the shape at its start.
std::shared_ptr<const MeshMotion> meshMotionOf(const Instance& before, const PlacedShape& now, std::int64_t begin_ns,
                                               std::int64_t end_ns, const MemoryBudget& memory) {
  const bool goes_on = before.mesh_motion && before.mesh_motion->end_ns() > begin_ns;
  const bool same = before.shape->geometry == now.shape->geometry;
  if (!same && !isDeformed(before, now)) return nullptr;
  if (same || before.shape->model.positions == now.shape->model.positions)
    return goes_on ? before.mesh_motion : nullptr;
  if (end_ns <= begin_ns) end_ns = begin_ns + kAbruptBlend_ns;
  MemoryShare own(memory);
  own.take(kPointer_bytes + sizeof(MeshMotion));
  MeshMotion motion = goes_on ? before.mesh_motion->then(now.shape, begin_ns, end_ns, memory)
                              : MeshMotion(MeshTransition(before.shape, now.shape, begin_ns, end_ns, memory));
  return withShare(std::make_shared<const MeshMotion>(std::move(motion)), std::move(own));
}

// In the time in which the mesh deforms, if it does. An object that was rigid before yields more and more.
std::shared_ptr<const ComplianceMotion> complianceOf(const Instance& before, const PlacedShape& now,
                                                     const MeshMotion* mesh, std::int64_t begin_ns,
                                                     std::int64_t end_ns) {
  if (!before.compliance && !now.compliance) return nullptr;
  const Compliance to = now.compliance.value_or(Compliance{});
  const bool deforms = mesh != nullptr && mesh->last().end_ns() > begin_ns;
  if (before.compliance && before.compliance->last().to == to) {
    const bool is_rigid = !now.compliance && before.compliance->last().end_ns <= begin_ns;
    return is_rigid ? nullptr : before.compliance;
  }
  if (end_ns <= begin_ns) end_ns = begin_ns + kAbruptBlend_ns;
  const std::int64_t from_ns = deforms ? std::max(begin_ns, mesh->last().begin_ns()) : begin_ns;
  const ComplianceMotion so_far = before.compliance ? *before.compliance : ComplianceMotion(Compliance{});
  return std::make_shared<const ComplianceMotion>(so_far.then(to, from_ns, deforms ? mesh->last().end_ns() : end_ns));
}

// Of a surface that is no mesh, and has no transitions: the snapshot in which it last took the place of another one.
std::uint64_t replacedIn(const Instance& before, const Shape& now, std::uint64_t snapshot) {
  if (!now.source) return 0;
  return before.shape.get() == &now ? before.replaced_in : snapshot;
}

Instance follow(const PlacedShape& now, const Instance* before, std::int64_t begin_ns, std::int64_t end_ns,
                const MemoryBudget& memory, const Box& scene, Followed& all) {
  Instance instance{now.shape, now.surfaces, Motion(now.pose), now.key, now.session, now.object, now.name};
  instance.item = now.item;
  instance.answers_force = now.answers_force;
  instance.snaps = now.snaps;
  instance.fields = now.fields;
  instance.label = now.label;
  if (now.compliance) instance.compliance = std::make_shared<const ComplianceMotion>(*now.compliance);
  if (now.body)
    setBody(instance, followBody("object " + std::to_string(now.object), {*now.body, now.pose, now.shape->bounds},
                                 before, scene));
  if (before == nullptr || before->movesAsBody() || instance.movesAsBody()) return instance;
  if (end_ns > begin_ns) {
    const bool stays = before->motion.to() == now.pose;
    const bool rests = !before->motion.moves() || before->motion.last().end_ns() < begin_ns;
    if (!stays || !rests) instance.motion = stays ? before->motion : before->motion.then(now.pose, begin_ns, end_ns);
  }
  try {
    instance.mesh_motion = meshMotionOf(*before, now, begin_ns, end_ns, memory);
  } catch (const Error&) {  // no memory for the transition
    ++all.jumps;
    all.blend_ns = kAbruptBlend_ns;
  }
  instance.compliance = complianceOf(*before, now, instance.mesh_motion.get(), begin_ns, end_ns);
  return instance;
}

}  // namespace

Followed followOn(const std::vector<PlacedShape>& placed, std::span<const Instance* const> last, std::int64_t begin_ns,
                  std::int64_t end_ns, const MemoryBudget& memory, const Box& scene, std::uint64_t snapshot) {
  Followed result;
  if (placed.size() != last.size()) result.blend_ns = kAbruptBlend_ns;
  result.instances.reserve(placed.size());
  auto at = last.begin();
  for (const PlacedShape* now : pointersByKey(placed)) {
    at = std::find_if(at, last.end(), [&](const Instance* one) { return one->key >= now->key; });
    const Instance* const before = at != last.end() && (*at)->key == now->key ? *at : nullptr;
    result.instances.push_back(follow(*now, before, begin_ns, end_ns, memory, scene, result));
    if (before != nullptr) result.instances.back().replaced_in = replacedIn(*before, *now->shape, snapshot);
    result.blend_ns = std::max(result.blend_ns, blendOf(before, result.instances.back(), *now));
  }
  return result;
}

}  // namespace hl
