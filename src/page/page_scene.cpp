#include "page/page_scene.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/utf8.h"
#include "page/layout_materials.h"
#include "page/wire_bytes.h"
#include "scene/iso_shape.h"
#include "session/state_messages.h"

namespace hl {

namespace {

Box boundsAt(const Snapshot& snapshot, std::int64_t now_ns) {
  Box bounds;
  for (const Instance& instance : snapshot.instances) {
    const Box box = boxAt(instance.shape->bounds, instance.shownAt(now_ns));
    if (box.empty()) continue;
    bounds.extend(box.min);
    bounds.extend(box.max);
  }
  return bounds;
}

void addVolumes(const Snapshot& snapshot, proto::SceneLayout& layout) {
  for (std::size_t i = 0; i < snapshot.instances.size(); ++i) {
    const IsoSurface* const surface = isoSurfaceOf(snapshot.instances[i]);
    if (surface == nullptr) continue;
    const ValueRange& range = surface->volume()->pyramid.range();
    if (!(range.low <= range.high)) continue;  // all of its samples are missing
    proto::PlacedVolume& volume = *layout.add_volumes();
    volume.set_placed(static_cast<std::uint32_t>(i));
    volume.set_surface(snapshot.instances[i].key);
    volume.set_iso(surface->iso().value);
    volume.set_low(range.low);
    volume.set_high(range.high);
    volume.set_below(surface->iso().solid == SolidSide::kBelow);
  }
}

}  // namespace

bool PageScene::MeshPlacement::operator==(const MeshPlacement& other) const {
  const auto names = [](const MeshPlacement& place) {
    return std::tie(place.key, place.mesh, place.session, place.object, place.name);
  };
  const bool same_label = label == other.label || (label && other.label && *label == *other.label);
  return names(*this) == names(other) && same_label && (surfaces == other.surfaces || *surfaces == *other.surfaces);
}

void PageScene::addPlacement(const MeshPlacement& place, const Instance& instance, proto::SceneLayout& layout) {
  proto::PlacedMesh& placed = *layout.add_placed();
  placed.set_mesh(place.mesh);
  placed.set_session(place.session);
  placed.set_object(place.object);
  placed.set_name(place.name);
  const RigidBody* const body = place.session == 0 ? instance.body.get() : nullptr;
  if (place.label) placed.set_label(printable(place.label->name));
  if (!place.label && body != nullptr) placed.set_label(printable(body->name));  // of its file
  if (place.label && place.label->colour) placed.set_colour(place.label->colour->data(), place.label->colour->size());
  addMaterials(*place.surfaces, placed);
}

void PageScene::follow(const std::shared_ptr<const Snapshot>& newest, const PageScale& scale, std::int64_t now_ns) {
  if (presence_.use_count() == 1) {
    shown_ = waiting_ = nullptr;
    layout_.reset();
    meshes_.keep({});
    return;
  }
  takeNewest(newest, now_ns);
  if (shown_ && outdated(scale, now_ns)) layOut(scale, now_ns);
}

// A snapshot that waits for its meshes is shown before newer ones are looked at: else a scene with a new mesh in every
// frame would never be shown.
void PageScene::takeNewest(const std::shared_ptr<const Snapshot>& newest, std::int64_t now_ns) {
  if (!waiting_ && (newest != shown_ || meshes_.refines(now_ns))) {
    waiting_ = newest;
    waiting_placements_.clear();
    const std::vector<std::uint32_t> meshes = meshes_.numbersOf(*newest, now_ns);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const Instance& instance = newest->instances[i];
      waiting_placements_.push_back({instance.key, meshes[i], instance.session, instance.object, instance.name,
                                     instance.surfaces, instance.label});
    }
  }
  if (!waiting_ || !meshes_.ready()) return;
  shown_ = std::exchange(waiting_, nullptr);
  shown_placements_ = std::move(waiting_placements_);
}

bool PageScene::outdated(const PageScale& scale, std::int64_t now_ns) {
  if (!layout_ || layout_->scale != scale || layout_->name != shown_->name || layout_->placements != shown_placements_)
    return true;
  return now_ns - layout_->made_ns >= kSettle_ns && (settledElsewhere(now_ns) || hasOtherContents());
}

bool PageScene::settledElsewhere(std::int64_t now_ns) const {
  for (std::size_t i = 0; i < shown_->instances.size(); ++i) {
    const PoseSource& poses = shown_->instances[i].poses();
    const bool rests = !poses.moves() || now_ns - poses.restsFrom_ns() >= kSettle_ns;
    if (rests && !(poses.to() == layout_->poses[i])) return true;
  }
  return false;
}

bool PageScene::hasOtherContents() {
  if (layout_->compared_with == shown_->identity) return false;
  layout_->compared_with = shown_->identity;
  return !(layout_->bodies == LayoutBodies::of(*shown_)) || !(layout_->places == LayoutPlaces::of(*shown_));
}

void PageScene::layOut(const PageScale& scale, std::int64_t now_ns) {
  proto::ServerMessage message;
  proto::SceneLayout& out = *message.mutable_layout();
  layout_ = Layout{++last_layout_, shown_->name, scale, shown_placements_, {}, {}, now_ns};
  out.set_number(layout_->number);
  out.set_name(printable(layout_->name));
  out.set_proxy_radius(scale.radius_W);
  out.set_world_per_device(scale.world_per_device);
  if (const Box bounds = boundsAt(*shown_, now_ns); !bounds.empty()) {
    toProto(bounds.min, *out.mutable_bounds_min());
    toProto(bounds.max, *out.mutable_bounds_max());
  }
  for (std::size_t i = 0; i < shown_placements_.size(); ++i) {
    const MeshPlacement& place = shown_placements_[i];
    layout_->meshes.insert(place.mesh);
    layout_->poses.push_back(shown_->instances[i].shownAt(now_ns));
    appendPose(*out.mutable_poses(), layout_->poses.back());
    addPlacement(place, shown_->instances[i], out);
  }
  layout_->bodies = LayoutBodies::of(*shown_);
  layout_->places = LayoutPlaces::of(*shown_);
  layout_->compared_with = shown_->identity;
  addBodies(layout_->bodies, *shown_, out);
  addPlaces(layout_->places, out);
  addVolumes(*shown_, out);
  layout_->message = std::make_shared<const std::string>(message.SerializeAsString());
  if (!waiting_) meshes_.keep(layout_->meshes);
}

// Meshes come before the layout that places them, and are forgotten after it. What cannot be shown is reported once.
PageMessage PageScene::next(PageMemory& page) const {
  if (!layout_) return nullptr;
  if (page.layout != layout_->number) {
    for (const std::uint32_t mesh : layout_->meshes) {
      if (page.meshes.insert(mesh).second) return meshes_.message(mesh);
    }
    page.layout = layout_->number;
    return layout_->message;
  }
  proto::ServerMessage message;
  if (std::string lacking = meshes_.lacking(); lacking != page.lacking) {
    page.lacking = std::move(lacking);
    if (!page.lacking.empty()) {
      message.mutable_notice()->set_text(page.lacking);
      return std::make_shared<const std::string>(message.SerializeAsString());
    }
  }
  if (page.meshes.size() == layout_->meshes.size()) return nullptr;
  for (const std::uint32_t mesh : page.meshes) {
    if (!layout_->meshes.contains(mesh)) message.mutable_forget()->add_meshes(mesh);
  }
  page.meshes = layout_->meshes;
  return std::make_shared<const std::string>(message.SerializeAsString());
}

// The index in the layout of the object with this key; absent: it is not in the layout.
std::optional<std::uint32_t> PageScene::indexOf(std::uint64_t key) const {
  const auto at = std::lower_bound(layout_->placements.begin(), layout_->placements.end(), key,
                                   [](const MeshPlacement& place, std::uint64_t k) { return place.key < k; });
  if (at == layout_->placements.end() || at->key != key) return std::nullopt;
  return static_cast<std::uint32_t>(at - layout_->placements.begin());
}

void PageScene::describe(proto::State& state, std::span<const ObjectName> touched, const HoldingSnap& snap,
                         std::int64_t now_ns) const {
  if (!layout_) return;
  state.set_layout(layout_->number);
  for (std::size_t i = 0; i < layout_->poses.size(); ++i) {
    const Pose pose = shown_->instances[i].shownAt(now_ns);
    if (pose == layout_->poses[i]) continue;
    state.add_moved(static_cast<std::uint32_t>(i));
    appendPose(*state.mutable_moved_poses(), pose);
  }
  for (const ObjectName& object : touched) {
    const auto index = indexOf(object.key);
    if (index && std::find(state.touched().begin(), state.touched().end(), *index) == state.touched().end())
      state.add_touched(*index);
  }
  if (const auto holder = indexOf(snap.object.key)) {
    if (const auto held = layout_->places.indexOf({*holder, snap.number})) state.set_snap(*held);
  }
}

}  // namespace hl
