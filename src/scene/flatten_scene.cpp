#include "scene/flatten_scene.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/splitmix64.h"
#include "scene/polar.h"

namespace hl {

namespace {

constexpr std::size_t kVisitsPerInstance = 8;  // limit of visited items, for a hierarchy of many calls and few shapes

std::uint64_t mixed(std::uint64_t key, std::uint64_t next) {
  return splitmix64(key + (next << 1 | 1) * 0xbf58476d1ce4e5b9U);
}

// One traversal of the calls, from the world down to the shapes.
class Flattening {
 public:
  Flattening(const DefinedScene& scene, const FlattenContext& context)
      : scene_(scene),
        context_(context),
        memory_(context.memory),
        copies_(context.stretched_before, context.limits, context.memory) {}

  FlatScene run() {
    visit(*scene_.world, {{}, {}, 0, 0, mixed(0, context_.session), {}});
    for (const CalledJoint& joint : scene_.world->joints) memory_.take(bytesOfJoint(joint.spec));
    placed_.joints = placedJoints(scene_.world->joints, placed_, context_.session, context_.joints_before);
    return {withShare(std::make_shared<const PlacedList>(std::move(placed_)), std::move(memory_)), copies_.take()};
  }

 private:
  struct Call {
    Placement placement;
    SurfaceChange surface;
    std::uint32_t object, name;
    std::uint64_t key;
    std::shared_ptr<const BodySpec> body;  // of the object
  };

  void visit(const SceneItems& items, const Call& caller);
  void enter(const SceneItem& item, const Call& call);
  void add(const SceneItem& item, const Call& call, std::uint32_t number);
  void countBody();
  void addPlaces(const SceneItems& items, const Call& call, bool to_body);
  void count(const SceneItems& items);
  PlacedShape& place(const std::shared_ptr<const Shape>& shape, const Pose& pose, const Call& call);
  std::shared_ptr<const Surfaces> surfacesOf(const SurfaceChange& change);

  const DefinedScene& scene_;
  const FlattenContext context_;
  MemoryShare memory_;  // memory of the placed shapes and their surfaces
  PlacedList placed_;
  std::vector<std::uint32_t> path_;
  std::size_t visits_ = 0, bodies_ = 0, snaps_ = 0, snap_points_ = 0, fields_ = 0, field_points_ = 0;
  StretchedCopies copies_;
  SurfaceChange last_change_;
  std::shared_ptr<const Surfaces> last_surfaces_;  // of last_change_; most objects repeat it
};

// The n-th call of an object is identified with its n-th call in the last frame, and so is the n-th shape.
void Flattening::visit(const SceneItems& items, const Call& caller) {
  std::map<std::uint32_t, std::uint64_t> occurrences;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const SceneItem& item = items[i];
    if (++visits_ > kVisitsPerInstance * context_.limits.instances)
      throw Error("there are too many calls in the world; the limit on objects in it is " +
                  std::to_string(context_.limits.instances));
    const std::uint64_t key = mixed(mixed(caller.key, item.call), occurrences[item.call]++);
    const Call call{item.placement ? caller.placement * *item.placement : caller.placement,
                    item.surface ? item.surface->over(caller.surface) : caller.surface,
                    caller.object,
                    item.name.value_or(caller.name),
                    key,
                    caller.body};
    item.shape ? add(item, call, static_cast<std::uint32_t>(i)) : enter(item, call);
  }
}

void Flattening::enter(const SceneItem& item, const Call& call) {
  const auto found = scene_.objects.find(item.call);
  if (found == scene_.objects.end()) return;
  if (std::find(path_.begin(), path_.end(), item.call) != path_.end())
    throw Error("object " + std::to_string(item.call) + " calls itself");
  if (path_.size() >= context_.limits.nesting)
    throw Error("calls are nested deeper than " + std::to_string(context_.limits.nesting));
  path_.push_back(item.call);
  Call inner = call;
  inner.object = item.call;
  inner.body = found->second->body;
  const SceneItems& items = *found->second;
  const std::size_t before = placed_.size();
  visit(items, inner);
  if (items.snaps || items.fields) addPlaces(items, inner, items.body && placed_.size() > before);
  path_.pop_back();
}

PlacedShape& Flattening::place(const std::shared_ptr<const Shape>& shape, const Pose& pose, const Call& call) {
  if (placed_.size() >= context_.limits.instances)
    throw Error("there are more than " + std::to_string(context_.limits.instances) + " objects in the world");
  memory_.take(bytesInWorld());
  placed_.push_back({shape, surfacesOf(call.surface), pose, call.key, context_.session, call.object, call.name});
  return placed_.back();
}

void Flattening::add(const SceneItem& item, const Call& call, std::uint32_t number) {
  if (item.shape->count() == 0) return;
  const Polar polar = polarOf(call.placement.linear);
  const Pose pose{polar.rotation, call.placement.offset};
  const std::shared_ptr<const Shape> shape = copies_.of(item.shape, polar.stretch);
  const Box box = boxAt(shape->bounds, pose);
  if (shape->count() == 0) return;
  // A volume without a surface of its iso value is nowhere. It stays an object: when there is a surface again, the
  // proxy is let out of its matter.
  const bool far = !box.empty() && (!withinReach(box.min) || !withinReach(box.max));
  if (!withinReach(pose.origin) || far)
    throw Error("an object lies farther than 1e9 m from the origin: nothing so far can be touched");
  PlacedShape& placed = place(shape, pose, call);
  placed.item = number;
  const auto found = scene_.compliances.find(call.object);
  if (found != scene_.compliances.end()) placed.compliance = found->second;
  placed.answers_force = scene_.answers_force;
  placed.body = call.body;
  if (placed.movesAsBody()) countBody();
}

void Flattening::countBody() {
  memory_.take(kBody_bytes);
  if (++bodies_ > context_.limits.bodies)
    throw Error("there are more than " + std::to_string(context_.limits.bodies) + " bodies in the world");
}

void Flattening::count(const SceneItems& items) {
  const auto check = [](std::size_t count, std::size_t most, const char* what) {
    if (count > most) throw Error("there are more than " + std::to_string(most) + " " + what + " in the world");
  };
  snaps_ += items.snaps ? items.snaps->size() : 0;
  snap_points_ += items.snaps ? pointsIn(*items.snaps) : 0;
  fields_ += items.fields ? items.fields->size() : 0;
  field_points_ += items.fields ? pointsIn(*items.fields) : 0;
  check(snaps_, kMaxSnaps, "snaps");
  check(snap_points_, kMaxSnapPoints, "points of snaps");
  check(fields_, kMaxFields, "fields");
  check(field_points_, kMaxSnapPoints, "points of fields");
  memory_.take(2 * kPointer_bytes + (items.snaps ? bytesOf(*items.snaps) : 0) +
               (items.fields ? bytesOf(*items.fields) : 0));
}

// Snaps and fields of a body move with it. Others get an instance of their own, so that an object needs nothing to
// touch.
void Flattening::addPlaces(const SceneItems& items, const Call& call, bool to_body) {
  static const std::shared_ptr<const Shape> kNothing = makeShape(Model{});
  constexpr std::uint64_t kOwnKey = 0x736e6170;
  const Polar polar = polarOf(call.placement.linear);
  if (!withinReach(call.placement.offset))
    throw Error("a snap or field lies farther than 1e9 m from the origin: nothing so far can be felt");
  count(items);
  Call there = call;
  there.key = mixed(call.key, kOwnKey);
  PlacedShape& own = to_body ? placed_.back() : place(kNothing, {polar.rotation, call.placement.offset}, there);
  const Placement stretch{polar.stretch, Vec3::Zero()};
  if (items.snaps) own.snaps = std::make_shared<const SnapList>(hl::placed(*items.snaps, stretch));
  if (items.fields) own.fields = std::make_shared<const FieldList>(hl::placed(*items.fields, stretch));
}

std::shared_ptr<const Surfaces> Flattening::surfacesOf(const SurfaceChange& change) {
  if (last_surfaces_ && change == last_change_) return last_surfaces_;
  memory_.take(kPointer_bytes + sizeof(Surfaces) + sizeof(Material) +
               2 * kQuantities * sizeof(std::shared_ptr<const Texture>));
  auto surfaces = std::make_shared<Surfaces>();
  Material material = change.material();
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const auto& use = change.textures[i];
    if (!use) continue;
    const auto found = scene_.textures.find(use->texture);
    if (found == scene_.textures.end()) throw Error("there is no texture '" + use->texture + "'");
    material.textures[i] = {static_cast<std::uint32_t>(surfaces->textures.size()), use->low, use->high};
    surfaces->textures.push_back(found->second);
  }
  surfaces->materials.push_back(material);
  last_change_ = change;
  return last_surfaces_ = std::move(surfaces);
}

}  // namespace

FlatScene flatten(const DefinedScene& scene, const FlattenContext& context) { return Flattening(scene, context).run(); }

}  // namespace hl
