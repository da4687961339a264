#include "scene/editable_scene.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"
#include "scene/flatten_scene.h"

namespace hl {

DefinedScene EditableScene::after(SceneEdit edit) const {
  DefinedScene next = state_;
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

void EditableScene::checkLimits(const DefinedScene& state) const {
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
  FlatScene flat = flatten(next.state_, {session_, limits_, memory_, stretched_, placed_->joints});
  next.placed_ = std::move(flat.placed);
  next.stretched_ = std::move(flat.stretched);
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

}  // namespace hl
