#include "session/frame_changes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

constexpr std::size_t kMoved_bytes = 512;  // of one item whose vertices move

}  // namespace

SceneItem& FrameChanges::itemToMove(const proto::VertexUpdate& in, const std::string& where) {
  SceneItems& items = objects_.toChange(in.object(), where);
  if (in.item() >= items.size() || !items[in.item()].shape || items[in.item()].shape->source)
    throw Error(where + ": item " + std::to_string(in.item()) + " of object " + std::to_string(in.object()) +
                " has no vertices");
  if (items.body && !items.body->fixed)
    throw Error(where + ": object " + std::to_string(in.object()) + " is a rigid body: define it anew, or as fixed");
  return items[in.item()];
}

void FrameChanges::move(const proto::VertexUpdate& in, Model& model, const std::string& where) {
  const Model part = shapes_.vertices(in, where);
  const std::size_t count = model.positions.size();
  if (in.first() > count || part.positions.size() > count - in.first())
    throw Error(where + ": the item has " + std::to_string(count) + " vertices, no more");
  if (!part.normals.empty() && model.normals.empty()) throw Error(where + ": the item's vertices have no normals");
  std::copy(part.positions.begin(), part.positions.end(), model.positions.begin() + in.first());
  if (!part.normals.empty()) std::copy(part.normals.begin(), part.normals.end(), model.normals.begin() + in.first());
}

// However many updates an item has, its shape is made once.
void FrameChanges::addMoved() {
  struct Moved {
    SceneItem* item;
    Model model;
    MemoryShare memory;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Moved> all;
  for (int i = 0; i < frame_.moved_size(); ++i) {
    const proto::VertexUpdate& in = frame_.moved(i);
    const std::string where = pathOf("moved", i);
    auto place = all.find({in.object(), in.item()});
    if (place == all.end()) {
      SceneItem& item = itemToMove(in, where);
      MemoryShare memory(memory_);
      memory.take(kMoved_bytes + bytesToMake(item.shape->model));
      Moved moved{&item, item.shape->model, std::move(memory)};
      place = all.emplace(std::pair(in.object(), in.item()), std::move(moved)).first;
    }
    move(in, place->second.model, where);
  }
  for (auto& [key, moved] : all) {
    const auto before = moved.item->shape;
    const auto shape = makeShape(std::move(moved.model), *before);
    moved.memory.set(shape->bytes());
    const std::string where = pathOf(pathOfItems(key.first), static_cast<int>(key.second));
    moved.item->shape = report_.noted(withShare(shape, std::move(moved.memory)), where);
  }
}

void FrameChanges::addIsos() {
  for (int i = 0; i < frame_.isos_size(); ++i) {
    const proto::IsoUpdate& in = frame_.isos(i);
    const std::string where = pathOf("isos", i);
    SceneItems& items = objects_.toChange(in.object(), where);
    const bool there = in.item() < items.size();
    const Shape* const before = there ? items[in.item()].shape.get() : nullptr;
    auto shape = shapes_.surfaceAt(before, in, where);
    items[in.item()].shape = std::move(shape);
  }
}

// Of objects that are there when the frame is shown.
void FrameChanges::addCompliances(SceneEdit& edit) {
  for (int i = 0; i < frame_.compliances_size(); ++i) {
    const proto::Compliance& in = frame_.compliances(i);
    const std::string where = pathOf("compliances", i);
    if (in.object() == 0 || !objects_.isThere(in.object()))
      throw Error(where + ": there is no object " + std::to_string(in.object()));
    const auto force = [&](double value, const char* axis) {
      return decoder_.checked(value, -kMaxComputedForce_N, kMaxComputedForce_N, where + ".computedForN." + axis);
    };
    const double normal_m_N = decoder_.checked(in.normal_m_n(), 0, kMaxCompliance_m_N, where + ".normalMN");
    const double tangential_m_N =
        in.has_tangential_m_n() ? decoder_.checked(in.tangential_m_n(), 0, kMaxCompliance_m_N, where + ".tangentialMN")
                                : normal_m_N;
    const proto::Vec3& f = in.computed_for_n();
    const Compliance compliance{normal_m_N, tangential_m_N, {force(f.x(), "x"), force(f.y(), "y"), force(f.z(), "z")}};
    if (!edit.compliances.emplace(in.object(), compliance).second)
      throw Error(where + ": object " + std::to_string(in.object()) + " is there twice");
  }
}

}  // namespace hl
