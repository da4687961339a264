#include "bodies/meetings.h"

#include <algorithm>
#include <numeric>

#include "bodies/row.h"

namespace hl {

Meetings::Meetings(const World& world) : along_x_(world.bodies.size()), joined_(world), fixed_(world.fixed) {
  meetings_.reserve(kContactsPerBody * world.bodies.size());
  near_.reserve(4 * kContactsPerBody);
  std::iota(along_x_.begin(), along_x_.end(), 0u);
}

void Meetings::look(std::int64_t time_ns) {
  if (fixed_) scene_.emplace(*fixed_, time_ns, recent_);
}

void Meetings::find(const World& world, const WorldState& state, const PlacedBodies& placed, double margin) {
  meetings_.clear();
  dropped_ = 0;
  if (scene_) withScene(state, world, placed, margin);
  withBodies(state, world, placed, margin);
}

void Meetings::add(const Meeting& meeting) {
  if (meetings_.size() < meetings_.capacity())
    meetings_.push_back(meeting);
  else
    ++dropped_;
}

void Meetings::withScene(const WorldState& state, const World& world, const PlacedBodies& placed, double margin) {
  PlacedRoom room;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    near_.clear();
    const double reach = world.bodies[i].shape.reach + margin;
    scene_->primitivesWithin(state.bodies[i].centre, reach, [&](PrimitiveId id, const ClosestPoint&) {
      if (near_.size() < near_.capacity())
        near_.push_back(id);
      else
        ++dropped_;
    });
    std::sort(near_.begin(), near_.end(), [&](PrimitiveId x, PrimitiveId y) { return scene_->precedes(x, y); });
    near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
    for (const PrimitiveId id : near_) {
      Meeting meeting{static_cast<int>(i), Row::kFixed, id, {}, 0};
      const PlacedConvex other =
          hl::placed(scene_->primitive(id), scene_->instance(id).poses().at(scene_->time_ns()), room);
      if (findManifold(placed[i], other, margin, meeting.manifold)) add(meeting);
    }
  }
}

// Sorted by their lowest x, each meets those that begin before it ends. The order of the step before is nearly right,
// so that sorting by insertion costs one pass.
void Meetings::withBodies(const WorldState& state, const World& world, const PlacedBodies& placed, double margin) {
  const auto low = [&](std::uint32_t i) { return state.bodies[i].centre.x() - world.bodies[i].shape.reach; };
  for (std::size_t i = 1; i < along_x_.size(); ++i) {
    for (std::size_t j = i; j > 0 && low(along_x_[j]) < low(along_x_[j - 1]); --j)
      std::swap(along_x_[j], along_x_[j - 1]);
  }
  const std::size_t first = meetings_.size();
  for (std::size_t i = 0; i < along_x_.size(); ++i) {
    const std::uint32_t one = along_x_[i];
    const double end = state.bodies[one].centre.x() + world.bodies[one].shape.reach + margin;
    for (std::size_t j = i + 1; j < along_x_.size() && low(along_x_[j]) <= end; ++j) {
      const std::uint32_t a = std::min(one, along_x_[j]), b = std::max(one, along_x_[j]);
      const double reach = world.bodies[a].shape.reach + world.bodies[b].shape.reach + margin;
      if ((state.bodies[a].centre - state.bodies[b].centre).squaredNorm() > reach * reach) continue;
      if (joined_.has(a, b)) continue;
      Meeting meeting{static_cast<int>(a), static_cast<int>(b), {}, {}, 0};
      if (findManifold(placed[a], placed[b], margin, meeting.manifold)) add(meeting);
    }
  }
  std::sort(meetings_.begin() + static_cast<std::ptrdiff_t>(first), meetings_.end(),
            [](const Meeting& x, const Meeting& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
}

}  // namespace hl
