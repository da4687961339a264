#include "share/replicas_here.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "base/error.h"
#include "base/splitmix64.h"

namespace hl {

namespace {

std::uint64_t keyOf(ItemId id, std::uint32_t session) { return std::max<std::uint64_t>(1, splitmix64(id ^ session)); }

bool isSame(const PlacedShape& a, const PlacedShape& b) {
  return a.key == b.key && a.pose == b.pose && a.shape == b.shape && a.surfaces == b.surfaces && a.body == b.body &&
         a.snaps == b.snaps && a.fields == b.fields;
}

}  // namespace

ReplicasHere::ReplicasHere(PlacedClient& client, bool bodies, BackgroundWork& work, const Contents& contents,
                           FitHands fit, ReportLine report)
    : client_(client),
      bodies_(bodies),
      work_(work),
      contents_(contents),
      fit_(std::move(fit)),
      report_(std::move(report)),
      reader_(std::make_shared<ItemReader>(client.memory())) {}

void ReplicasHere::look(const std::vector<Replica>& replicas, bool jumped, std::int64_t now_ns) {
  ++looks_;
  auto placed = std::make_shared<PlacedList>();
  for (const Replica& replica : replicas) {
    Row& row = rows_[replica.id];
    if (row.number == 0) {
      row.number = ++last_number_;
      ids_[row.number] = replica.id;
    }
    row.look = looks_;
    setBody(row, replica);
    row.replica = replica;
    readNew(row);
    if (row.instance) placed->push_back(placedOf(row));
  }
  std::erase_if(ids_, [&](const auto& entry) { return rows_.at(entry.second).look != looks_; });
  std::erase_if(rows_, [&](const auto& entry) { return entry.second.look != looks_; });
  if (!isAsPlaced(*placed) && !waitsForOthers(*placed, now_ns)) place(placed, jumped ? kJump_ns : kMove_ns);
}

// Where the first ones are fitted to the hands: until all are here, so that all are within reach.
bool ReplicasHere::waitsForOthers(const PlacedList& placed, std::int64_t now_ns) {
  if (!fit_ || placed.empty()) return false;
  if (first_ns_ == 0) first_ns_ = now_ns;
  if (placed.size() < rows_.size() && now_ns - first_ns_ < kPatience_ns) return true;
  Box bounds;
  for (const PlacedShape& one : placed) bounds.extend(boxAt(one.shape->bounds, one.pose));
  std::exchange(fit_, nullptr)(bounds);
  return false;
}

// The shape is made by the background work; until then it is as it was.
void ReplicasHere::readNew(Row& row) {
  const Replica& replica = row.replica;
  if (!replica.content || row.asked == replica.content) return;
  const Content shape = contents_.find(nameOf(replica.content->shape()));
  const Content surfaces = contents_.find(nameOf(replica.content->surfaces()));
  if (!shape || !surfaces) return;
  row.asked = replica.content;
  work_.post([this, id = replica.id, content = replica.content, shape, surfaces,
              reader = reader_]() -> BackgroundWork::Finish {
    try {
      return [this, id, content, read = reader->read(*content, *shape, *surfaces)] {
        const auto found = rows_.find(id);
        if (found != rows_.end() && found->second.asked == content) found->second.instance = read;
      };
    } catch (const std::exception& error) {
      return [this, why = std::string(error.what())] { report_("an object of another server is left out: " + why); };
    }
  });
}

// A body that this server has taken over goes on from where it was; one that joints have held rests, as they are not
// shared.
void ReplicasHere::setBody(Row& row, const Replica& replica) const {
  const bool moved = bodies_ && replica.own && replica.content && replica.content->body() &&
                     !replica.content->jointed() && row.instance && row.instance->body;
  if (!moved) {
    row.body = nullptr;
    return;
  }
  if (row.body && row.replica.begin == replica.begin) return;
  BodySpec spec = row.instance->body->spec;
  spec.velocity_m_s = replica.begin.velocity_m_s;
  spec.spin_rad_s = replica.begin.spin_rad_s;
  row.body = std::make_shared<const BodySpec>(spec);
}

PlacedShape ReplicasHere::placedOf(const Row& row) const {
  PlacedShape placed{row.instance->shape, row.instance->surfaces,
                     row.replica.own ? row.replica.begin.pose : row.replica.pose,
                     keyOf(row.replica.id, client_.session())};
  placed.session = client_.session();
  placed.object = row.number;
  placed.name = row.instance->name;
  placed.snaps = row.instance->snaps;
  placed.fields = row.instance->fields;
  placed.label = row.instance->label;
  placed.body = row.body;
  return placed;
}

bool ReplicasHere::isAsPlaced(const PlacedList& placed) const {
  return std::equal(placed.begin(), placed.end(), placed_->begin(), placed_->end(),
                    [](const PlacedShape& a, const PlacedShape& b) { return isSame(a, b); });
}

// Where there is no room for their bodies they rest.
void ReplicasHere::place(const PlacedShapes& placed, std::int64_t move_ns) {
  placed_ = placed;
  try {
    client_.place(placed, move_ns);
    return refused_.clear();
  } catch (const Error& error) {
    if (refused_ != error.what()) report_(std::string("bodies that were taken over rest: ") + error.what());
    refused_ = error.what();
  }
  auto resting = std::make_shared<PlacedList>(*placed);
  for (PlacedShape& one : *resting) one.body = nullptr;
  client_.place(resting, move_ns);
}

void ReplicasHere::addOwn(const Snapshot& scene, LocalItems& items) const {
  for (const auto& [id, row] : rows_) {
    if (!row.replica.own) continue;
    LocalItem item{nullptr, {row.replica.begin.pose}};
    std::uint32_t number = 0;
    if (row.body && scene.find(keyOf(id, client_.session()), number) && scene.instances[number].movesAsBody())
      item.motion = motionOf(scene.instances[number], 0);
    items[id] = item;
  }
}

std::optional<ItemId> ReplicasHere::idOf(std::uint32_t number) const {
  const auto found = ids_.find(number);
  return found == ids_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint64_t> ReplicasHere::bodyOf(ItemId id) const {
  const auto found = rows_.find(id);
  if (found == rows_.end() || !found->second.body) return std::nullopt;
  return keyOf(id, client_.session());
}

Pose ReplicasHere::poseOf(ItemId id) const {
  const auto found = rows_.find(id);
  return found == rows_.end() ? Pose{} : found->second.replica.pose;
}

}  // namespace hl
