#include "bodies/meetings.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bodies/row.h"

namespace hl {

Meetings::Meetings(const World& world) : along_x_(world.bodies.size()), joined_(world), fixed_(world.fixed) {
  std::size_t room = 0;
  for (const Body& body : world.bodies) room += kMeetingsPerBody + kMeetingsPerPart * (body.shape.parts.size() - 1);
  meetings_.reserve(room);
  near_.reserve(NearPrimitives::kOctants * NearPrimitives::kPerOctant);
  std::iota(along_x_.begin(), along_x_.end(), 0u);
  for (const Body& body : world.bodies) {
    reach_.push_back(body.shape.reach);
    widest_ = std::max(widest_, body.shape.reach);
  }
  low_x_.resize(world.bodies.size());
}

void Meetings::look(std::int64_t time_ns) {
  if (fixed_) scene_.emplace(*fixed_, time_ns, recent_);
}

void Meetings::find(const WorldState& state, const PlacedBodies& placed, double margin) {
  meetings_.clear();
  dropped_ = 0;
  if (scene_) withScene(state, placed, margin);
  withBodies(state, placed, margin);
}

void Meetings::add(const Meeting& meeting) {
  if (meetings_.size() < meetings_.capacity())
    meetings_.push_back(meeting);
  else
    ++dropped_;
}

void Meetings::withScene(const WorldState& state, const PlacedBodies& placed, double margin) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    if (state.bodies[i].island != 0) continue;
    Meeting meeting;
    meeting.a = static_cast<int>(i);
    meeting.b = Row::kFixed;
    for (const PlacedConvex& part : placed[i]) {
      partWithScene(meeting, part, margin);
      ++meeting.part_a;
    }
  }
}

PlacedConvex Meetings::placedOf(PrimitiveId id, PlacedRoom& room) const {
  return hl::placed(scene_->primitive(id), scene_->instance(id).poses().at(scene_->time_ns()), room);
}

void Meetings::partWithScene(Meeting& meeting, const PlacedConvex& part, double margin) {
  PlacedRoom room;
  nearest_.clear();
  scene_->primitivesWithin(part.centre, part.shape->reach + margin, [&](PrimitiveId id, const ClosestPoint& nearest) {
    if (separationBound(part, nearest) > margin) return;
    const double separation = separationBound(part, placedOf(id, room), nearest);
    if (separation <= margin && !nearest_.has(id, nearest)) nearest_.add(id, separation, nearest, *scene_);
  });
  near_.clear();
  nearest_.forEach([&](PrimitiveId id) { near_.push_back(id); });
  std::sort(near_.begin(), near_.end(), [&](PrimitiveId x, PrimitiveId y) { return scene_->precedes(x, y); });
  for (const PrimitiveId id : near_) {
    meeting.primitive = id;
    if (findManifold(part, placedOf(id, room), margin, meeting.manifold)) add(meeting);
  }
}

// What sleeps is the second of a pair.
void Meetings::meet(const WorldState& state, const PlacedBodies& placed, double margin, std::uint32_t one,
                    std::uint32_t other) {
  const double reach = reach_[one] + reach_[other] + margin;
  if ((state.bodies[one].centre - state.bodies[other].centre).squaredNorm() > reach * reach) return;
  if (joined_.has(one, other)) return;
  const bool in_order = state.bodies[other].island != 0 || one < other;
  const std::uint32_t a = in_order ? one : other, b = in_order ? other : one;
  Meeting meeting;
  meeting.a = static_cast<int>(a);
  meeting.b = static_cast<int>(b);
  for (const PlacedConvex& part_a : placed[a]) {
    meeting.part_b = 0;
    for (const PlacedConvex& part_b : placed[b]) {
      const double near = part_a.shape->reach + part_b.shape->reach + margin;
      const bool within = (part_a.centre - part_b.centre).squaredNorm() <= near * near;
      if (within && findManifold(part_a, part_b, margin, meeting.manifold)) add(meeting);
      ++meeting.part_b;
    }
    ++meeting.part_a;
  }
}

// Sorted by their lowest x, each that is awake meets those that begin before it ends, and of those before it the
// sleeping ones. The order of the step before is nearly right, so that sorting by insertion costs one pass.
void Meetings::withBodies(const WorldState& state, const PlacedBodies& placed, double margin) {
  for (std::size_t i = 0; i < low_x_.size(); ++i) low_x_[i] = state.bodies[i].centre.x() - reach_[i];
  for (std::size_t i = 1; i < along_x_.size(); ++i) {
    for (std::size_t j = i; j > 0 && low_x_[along_x_[j]] < low_x_[along_x_[j - 1]]; --j)
      std::swap(along_x_[j], along_x_[j - 1]);
  }
  const std::size_t first = meetings_.size();
  for (std::size_t i = 0; i < along_x_.size(); ++i) {
    const std::uint32_t one = along_x_[i];
    if (state.bodies[one].island != 0) continue;
    const double begin = low_x_[one] - 2 * widest_ - margin, end = low_x_[one] + 2 * reach_[one] + margin;
    for (std::size_t j = i + 1; j < along_x_.size() && low_x_[along_x_[j]] <= end; ++j)
      meet(state, placed, margin, one, along_x_[j]);
    for (std::size_t j = i; j > 0 && low_x_[along_x_[j - 1]] >= begin; --j) {
      if (state.bodies[along_x_[j - 1]].island != 0) meet(state, placed, margin, one, along_x_[j - 1]);
    }
  }
  std::sort(meetings_.begin() + static_cast<std::ptrdiff_t>(first), meetings_.end(),
            [](const Meeting& x, const Meeting& y) {
              return std::tie(x.a, x.b, x.part_a, x.part_b) < std::tie(y.a, y.b, y.part_a, y.part_b);
            });
}

}  // namespace hl
