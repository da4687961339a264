#include "scene/editable_scene.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/splitmix64.h"
#include "scene/by_key.h"
#include "scene/follow_body.h"

namespace hl {

namespace {

// Rounding error of a stretch from the product of matrices, relative; closer stretches are the same.
constexpr double kSameStretch = 1.0 / (std::int64_t{1} << 36);
constexpr double kRigid = 1e-12;               // error of a product of a hundred rotations is below this
constexpr double kFlattest = 1e-9;             // minimum ratio of the smallest to the largest stretch
constexpr std::size_t kVisitsPerInstance = 8;  // limit of visited items, for a hierarchy of many calls and few shapes

// Polar decomposition linear = rotation * stretch, which is unique; of a mirrored object the stretch has all axes
// negative.
struct Polar {
  Mat3 rotation, stretch;
};

Polar polarOf(const Mat3& linear) {
  if (!linear.allFinite()) throw Error("the product of an object's matrices is not finite");
  const bool rigid = (linear.transpose() * linear - Mat3::Identity()).cwiseAbs().maxCoeff() < kRigid;
  const double handed = linear.determinant() < 0 ? -1 : 1;
  if (rigid) return {handed * linear, handed * Mat3::Identity()};
  const Eigen::JacobiSVD<Mat3> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3& factors = svd.singularValues();
  if (!(factors.z() > kFlattest * factors.x())) throw Error("a matrix flattens an object: it cannot be touched so");
  const Mat3 rotation = handed * svd.matrixU() * svd.matrixV().transpose();
  const Mat3 stretch = handed * svd.matrixV() * factors.asDiagonal() * svd.matrixV().transpose();
  const double unit = kSameStretch * std::exp2(std::round(std::log2(factors.x())));
  return {rotation, (stretch / unit).array().round().matrix() * unit};
}

std::uint64_t mixed(std::uint64_t key, std::uint64_t next) {
  return splitmix64(key + (next << 1 | 1) * 0xbf58476d1ce4e5b9U);
}

constexpr std::size_t kPointer_bytes = 96;  // control block of a shared pointer, with the overhead of malloc()

}  // namespace

std::size_t bytesOfItems(std::size_t count) { return kObject_bytes + count * sizeof(SceneItem); }

std::size_t bytesApart(const SceneItem& item) {
  std::size_t bytes = item.placement ? kPointer_bytes + sizeof(Placement) : 0;
  if (!item.surface) return bytes;
  bytes += kPointer_bytes + sizeof(SurfaceChange);
  for (const auto& use : item.surface->textures) {
    if (use) bytes += use->texture.capacity();
  }
  return bytes;
}

std::size_t bytesInWorld() {
  constexpr std::size_t kSnapshots = 5;
  constexpr std::size_t kInSnapshot = sizeof(Instance) + sizeof(Box) + 64;  // with the leaf of the tree over instances
  constexpr std::size_t kInLayout = 768;    // poses and positions, and the message to the page
  constexpr std::size_t kWhileGrowing = 3;  // while a list is doubled, old and new exist
  return kWhileGrowing * sizeof(PlacedShape) + kSnapshots * kInSnapshot + kInLayout;
}

std::shared_ptr<SceneItems> copyOf(const SceneItems& items, const MemoryBudget& budget) {
  MemoryShare memory(budget);
  memory.take(bytesOfItems(items.size()));
  for (const SceneItem& item : items) memory.take(bytesApart(item));
  for (const CalledJoint& joint : items.joints) memory.take(bytesOf(joint));
  return withShare(std::make_shared<SceneItems>(items), std::move(memory));
}

void ModelSizes::add(const Model& model, const std::string& where) { add(bytesToMake(model), where); }

void ModelSizes::add(std::size_t bytes, const std::string& where) {
  bytes_ += bytes;
  if (bytes_ <= most_bytes_) return;
  throw Error(where + "the shapes need more than the " + std::to_string(most_bytes_) +
              " bytes that one client may have");
}

// One traversal of the calls of a state, from the world down to the shapes.
class EditableScene::Flattening {
 public:
  Flattening(const EditableScene& scene, const State& state)
      : scene_(scene), state_(state), memory_(scene.memory_), copies_(scene.limits_) {}

  PlacedShapes run() {
    visit(*state_.world, {{}, {}, 0, 0, mixed(0, scene_.session_), {}});
    for (const CalledJoint& joint : state_.world->joints) memory_.take(bytesOfJoint(joint.spec));
    placed_.joints = placedJoints(state_.world->joints, placed_, scene_.session_, scene_.placed().joints);
    return withShare(std::make_shared<const PlacedList>(std::move(placed_)), std::move(memory_));
  }
  std::map<Stretched, std::shared_ptr<const Shape>> stretched;

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
  std::shared_ptr<const Shape> shapeOf(const std::shared_ptr<const Shape>& shape, const Mat3& stretch);
  std::shared_ptr<const Surfaces> surfacesOf(const SurfaceChange& change);

  const EditableScene& scene_;
  const State& state_;
  MemoryShare memory_;  // memory of the placed shapes and their surfaces
  PlacedList placed_;
  std::vector<std::uint32_t> path_;
  std::size_t visits_ = 0, bodies_ = 0, snaps_ = 0, snap_points_ = 0, fields_ = 0, field_points_ = 0;
  ModelSizes copies_;  // sizes of the stretched copies; a small matrix makes a copy of a large shape
  SurfaceChange last_change_;
  std::shared_ptr<const Surfaces> last_surfaces_;  // of last_change_; most objects repeat it
};

// The n-th call of an object is identified with its n-th call in the last frame, and so is the n-th shape.
void EditableScene::Flattening::visit(const SceneItems& items, const Call& caller) {
  std::map<std::uint32_t, std::uint64_t> occurrences;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const SceneItem& item = items[i];
    if (++visits_ > kVisitsPerInstance * scene_.limits_.instances)
      throw Error("there are too many calls in the world; the limit on objects in it is " +
                  std::to_string(scene_.limits_.instances));
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

void EditableScene::Flattening::enter(const SceneItem& item, const Call& call) {
  const auto found = state_.objects.find(item.call);
  if (found == state_.objects.end()) return;
  if (std::find(path_.begin(), path_.end(), item.call) != path_.end())
    throw Error("object " + std::to_string(item.call) + " calls itself");
  if (path_.size() >= scene_.limits_.nesting)
    throw Error("calls are nested deeper than " + std::to_string(scene_.limits_.nesting));
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

PlacedShape& EditableScene::Flattening::place(const std::shared_ptr<const Shape>& shape, const Pose& pose,
                                              const Call& call) {
  if (placed_.size() >= scene_.limits_.instances)
    throw Error("there are more than " + std::to_string(scene_.limits_.instances) + " objects in the world");
  memory_.take(bytesInWorld());
  placed_.push_back({shape, surfacesOf(call.surface), pose, call.key, scene_.session_, call.object, call.name});
  return placed_.back();
}

void EditableScene::Flattening::add(const SceneItem& item, const Call& call, std::uint32_t number) {
  if (item.shape->count() == 0) return;
  const Polar polar = polarOf(call.placement.linear);
  const Pose pose{polar.rotation, call.placement.offset};
  const std::shared_ptr<const Shape> shape = shapeOf(item.shape, polar.stretch);
  const Box box = boxAt(shape->bounds, pose);
  if (shape->count() == 0) return;
  // A volume without a surface of its iso value is nowhere. It stays an object: when there is a surface again, the
  // proxy is let out of its matter.
  const bool far = !box.empty() && (!withinReach(box.min) || !withinReach(box.max));
  if (!withinReach(pose.origin) || far)
    throw Error("an object lies farther than 1e9 m from the origin: nothing so far can be touched");
  PlacedShape& placed = place(shape, pose, call);
  placed.item = number;
  const auto found = state_.compliances.find(call.object);
  if (found != state_.compliances.end()) placed.compliance = found->second;
  placed.answers_force = state_.answers_force;
  placed.body = call.body;
  if (placed.movesAsBody()) countBody();
}

void EditableScene::Flattening::countBody() {
  memory_.take(kBody_bytes);
  if (++bodies_ > scene_.limits_.bodies)
    throw Error("there are more than " + std::to_string(scene_.limits_.bodies) + " bodies in the world");
}

void EditableScene::Flattening::count(const SceneItems& items) {
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
void EditableScene::Flattening::addPlaces(const SceneItems& items, const Call& call, bool to_body) {
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

// The hierarchy of a new copy is refitted from that of the copy that it replaces, or else from that of the shape.
std::shared_ptr<const Shape> EditableScene::Flattening::shapeOf(const std::shared_ptr<const Shape>& shape,
                                                                const Mat3& stretch) {
  if (stretch == Mat3::Identity()) return shape;
  const std::array<double, 6> upper{stretch(0, 0), stretch(0, 1), stretch(0, 2),
                                    stretch(1, 1), stretch(1, 2), stretch(2, 2)};
  auto& slot = stretched[{shape->geometry, upper}];
  if (slot) return slot;
  const auto& made = scene_.stretched_;
  const auto known = made.find({shape->geometry, upper});
  if (shape->source) return slot = known != made.end() ? known->second : placedShape(*shape, stretch, Vec3::Zero());
  copies_.add(shape->model, "in the scaled copies of objects, ");
  if (known != made.end()) return slot = known->second;
  const auto before = made.find({shape->before, upper});
  return slot = makeCounted(scene_.memory_, bytesToMake(shape->model), [&] {
           Model model = shape->model;
           placeModel(model, {stretch, Vec3::Zero()});
           return makeShape(std::move(model), before == made.end() ? *shape : *before->second);
         });
}

std::shared_ptr<const Surfaces> EditableScene::Flattening::surfacesOf(const SurfaceChange& change) {
  if (last_surfaces_ && change == last_change_) return last_surfaces_;
  memory_.take(kPointer_bytes + sizeof(Surfaces) + sizeof(Material) +
               2 * kQuantities * sizeof(std::shared_ptr<const Texture>));
  auto surfaces = std::make_shared<Surfaces>();
  Material material = change.material();
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const auto& use = change.textures[i];
    if (!use) continue;
    const auto found = state_.textures.find(use->texture);
    if (found == state_.textures.end()) throw Error("there is no texture '" + use->texture + "'");
    material.textures[i] = {static_cast<std::uint32_t>(surfaces->textures.size()), use->low, use->high};
    surfaces->textures.push_back(found->second);
  }
  surfaces->materials.push_back(material);
  last_change_ = change;
  return last_surfaces_ = std::move(surfaces);
}

EditableScene::State EditableScene::after(SceneEdit edit) const {
  State next = state_;
  for (const std::string& name : edit.deleted_textures) next.textures.erase(name);
  for (const std::uint32_t id : edit.deleted_objects) {
    next.objects.erase(id);
    next.compliances.erase(id);
  }
  for (auto& [name, texture] : edit.textures) next.textures[name] = std::move(texture);
  for (auto& [id, items] : edit.objects) next.objects[id] = std::move(items);
  for (const auto& [id, compliance] : edit.compliances) {
    if (next.objects.contains(id)) next.compliances[id] = compliance;
  }
  if (edit.world) next.world = std::move(edit.world);
  next.answers_force = edit.answers_force;
  return next;
}

void EditableScene::checkLimits(const State& state) const {
  const auto check = [](std::size_t count, std::size_t most, const char* what) {
    if (count > most) throw Error("there are more than " + std::to_string(most) + " " + what);
  };
  check(state.objects.size(), limits_.objects, "objects");
  std::size_t bytes = 0;
  for (const auto& [name, texture] : state.textures) bytes += texture->texels.size() * sizeof(float);
  check(bytes, limits_.texture_bytes, "bytes of textures");
  ModelSizes sizes(limits_);
  std::set<const void*> counted;
  const auto add = [&](const SceneItems& items) {
    for (const SceneItem& item : items) {
      if (!item.shape || !counted.insert(item.shape.get()).second) continue;
      sizes.add(item.shape->source ? item.shape->bytes() : bytesToMake(item.shape->model));
      if (const SharedMemory shared = item.shape->shared(); counted.insert(shared.of).second) sizes.add(shared.bytes);
    }
  };
  for (const auto& [id, items] : state.objects) add(*items);
  add(*state.world);
}

EditableScene::Next EditableScene::prepare(SceneEdit edit) const {
  Next next;
  next.state_ = after(std::move(edit));
  checkLimits(next.state_);
  Flattening flattening(*this, next.state_);
  next.placed_ = flattening.run();
  next.stretched_ = std::move(flattening.stretched);
  return next;
}

void EditableScene::show(Next& next) noexcept {
  std::swap(state_.textures, next.state_.textures);
  std::swap(state_.objects, next.state_.objects);
  std::swap(state_.compliances, next.state_.compliances);
  std::swap(state_.world, next.state_.world);
  std::swap(placed_, next.placed_);
  std::swap(stretched_, next.stretched_);
}

void EditableScene::apply(SceneEdit edit) {
  Next next = prepare(std::move(edit));
  show(next);
}

std::size_t EditableScene::primitives() const {
  std::size_t sum = 0;
  for (const PlacedShape& placed : *placed_) sum += placed.shape->count();
  return sum;
}

const SceneItems* EditableScene::items(std::uint32_t object) const {
  if (object == 0) return state_.world.get();
  const auto found = state_.objects.find(object);
  return found == state_.objects.end() ? nullptr : found->second.get();
}

std::shared_ptr<const Shape> EditableScene::toRebuild() const {
  const auto found = std::find_if(placed_->begin(), placed_->end(),
                                  [](const PlacedShape& p) { return p.shape->cost_ratio > kMaxCostRatio; });
  return found == placed_->end() ? nullptr : found->shape;
}

EditableScene::Next EditableScene::prepareReplaced(const std::shared_ptr<const Shape>& old,
                                                   const std::shared_ptr<const Shape>& rebuilt) const {
  Next next;
  next.state_ = state_;
  next.stretched_ = stretched_;
  const auto in = [&](std::shared_ptr<const SceneItems>& items) {
    const auto holds = [&](const SceneItem& item) { return item.shape == old; };
    if (std::none_of(items->begin(), items->end(), holds)) return;
    const auto replaced = copyOf(*items, memory_);
    for (SceneItem& item : *replaced) {
      if (holds(item)) item.shape = rebuilt;
    }
    items = replaced;
  };
  in(next.state_.world);
  for (auto& [id, items] : next.state_.objects) in(items);
  for (auto& [key, copy] : next.stretched_) {
    if (copy == old) copy = rebuilt;
  }
  MemoryShare memory(memory_);
  memory.take(placed_->size() * bytesInWorld());
  for (const JointSpec& joint : placed_->joints) memory.take(bytesOfJoint(joint));
  auto placed = std::make_shared<PlacedList>(*placed_);
  for (PlacedShape& one : *placed) {
    if (one.shape == old) one.shape = rebuilt;
  }
  next.placed_ = withShare(PlacedShapes(std::move(placed)), std::move(memory));
  return next;
}

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
