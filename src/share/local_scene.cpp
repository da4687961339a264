#include "share/local_scene.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "base/splitmix64.h"

namespace hl {

namespace {

// Whether what is published of both is the same.
bool isSameContent(const Instance& a, const Instance& b) {
  const auto same = [](const auto& x, const auto& y) { return x == y || (x && y && *x == *y); };
  const bool bodies = a.body && b.body ? a.body->spec == b.body->spec : !a.body && !b.body;
  return a.shape == b.shape && same(a.surfaces, b.surfaces) && bodies && a.name == b.name && same(a.snaps, b.snaps) &&
         same(a.fields, b.fields) && same(a.label, b.label);
}

std::set<std::uint64_t> jointedBodies(const Snapshot& scene) {
  std::set<std::uint64_t> bodies;
  for (const JointSpec& joint : scene.mechanics.joints) bodies.insert({joint.body_a, joint.body_b});
  return bodies;
}

std::uint64_t numberOf(const std::string& place) {
  const std::string sha256 = nameOf(place).sha256;
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) number = number << 8 | static_cast<unsigned char>(sha256[i]);
  return number;
}

}  // namespace

// A client's objects have keys of their own in each session, and its session has ended when the server is started anew.
ItemIds::ItemIds(const ShareSelf& self)
    : scene_(numberOf("scene of " + self.name)), clients_(numberOf("clients of " + std::to_string(self.id))) {}

ItemId ItemIds::of(const Instance& instance) const {
  const std::uint64_t place = instance.session == 0 ? scene_ : clients_;
  return std::max<ItemId>(1, splitmix64(place ^ splitmix64(instance.key)));
}

LocalScene::LocalScene(const ShareSelf& self, std::uint32_t others, BackgroundWork& work, Contents& contents,
                       ReportLine report)
    : ids_(self), others_(others), work_(work), contents_(contents), report_(std::move(report)) {}

void LocalScene::look(const Snapshot& scene, std::int64_t now_ns) {
  ++looks_;
  const std::set<std::uint64_t> jointed = jointedBodies(scene);
  for (const Instance& instance : scene.instances) {
    if (instance.session != others_) lookAt(instance, jointed.contains(instance.key), now_ns);
  }
  std::erase_if(rows_, [&](const auto& entry) {
    const bool gone = entry.second.look != looks_;
    if (gone) items_.erase(entry.first);
    return gone;
  });
}

// Null: there is no room for another one.
LocalScene::Row* LocalScene::rowOf(ItemId id, const Instance& instance) {
  const auto found = rows_.find(id);
  if (found != rows_.end()) return &found->second;
  if (rows_.size() < SharedWorld::kMaxItems) return &rows_.emplace(id, Row{instance}).first->second;
  if (!std::exchange(reported_many_, true))
    report_("others are told of " + std::to_string(rows_.size()) + " objects of this server, and it has more");
  return nullptr;
}

void LocalScene::lookAt(const Instance& instance, bool jointed, std::int64_t now_ns) {
  const ItemId id = ids_.of(instance);
  Row* const row = rowOf(id, instance);
  if (row == nullptr) return;
  row->look = looks_;
  if (row->content) items_[id] = {row->content, motionOf(instance, now_ns)};
  if (row->written == Written::kBeing) return;
  const bool same = row->jointed == jointed && isSameContent(row->instance, instance);
  if (row->written != Written::kNever && (same || now_ns - row->begun_ns < kDeformed_ns)) return;
  row->instance = instance;
  row->jointed = jointed;
  row->begun_ns = now_ns;
  write(id, *row);
}

void LocalScene::write(ItemId id, Row& row) {
  row.written = Written::kBeing;
  ++writing_;
  work_.post([this, id, writer = writer_, instance = row.instance, jointed = row.jointed]() -> BackgroundWork::Finish {
    try {
      return [this, id, written = writer->write(instance, jointed)] { take(id, written); };
    } catch (const std::exception& error) {
      return [this, id, why = std::string(error.what())] { refuse(id, why); };
    }
  });
}

void LocalScene::take(ItemId id, const WrittenItem& written) {
  --writing_;
  const auto row = rows_.find(id);
  if (row == rows_.end()) return;
  row->second.written = Written::kDone;
  row->second.content = written.content;
  row->second.shape = contents_.keep(written.shape.name, written.shape.bytes);
  row->second.surfaces = contents_.keep(written.surfaces.name, written.surfaces.bytes);
}

// It is tried again when it is another one.
void LocalScene::refuse(ItemId id, const std::string& why) {
  --writing_;
  const auto row = rows_.find(id);
  if (row == rows_.end()) return;
  report_("an object is not shared: " + why);
  row->second.written = Written::kRefused;
}

std::optional<std::uint64_t> LocalScene::bodyOf(ItemId id) const {
  const auto row = rows_.find(id);
  if (row == rows_.end() || !row->second.instance.movesAsBody()) return std::nullopt;
  return row->second.instance.key;
}

}  // namespace hl
