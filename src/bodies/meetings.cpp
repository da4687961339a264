#include "bodies/meetings.h"

#include <algorithm>
#include <cmath>

#include "bodies/permute.h"
#include "bodies/row.h"

namespace hl {

namespace {

// Cosine of the angle between a normal and that of a triangle, above which the two meet by its face.
constexpr double kByFace = 1 - 1e-9;

// What has corners slides, or tumbles: its rows must not wait for others.
bool rolls(const PlacedConvex& part) { return part.shape->radius > 0 || isRound(part); }

bool isBeside(const PlacedConvex& primitive, const Vec3& normal) {
  if (primitive.normals.empty() || isByFace(primitive, normal)) return false;
  return std::abs(normal.dot(primitive.normals[0])) >= kSameWay;
}

}  // namespace

bool isByFace(const PlacedConvex& primitive, const Vec3& normal) {
  return !primitive.normals.empty() && std::abs(normal.dot(primitive.normals[0])) >= kByFace;
}

Meetings::Meetings(const World& world) : joined_(world), fixed_(world.fixed) {
  std::size_t room = 0;
  for (const Body& body : world.bodies) room += kMeetingsPerBody + kMeetingsPerPart * (body.shape.parts.size() - 1);
  meetings_.reserve(room);
  order_.reserve(room);
  near_.reserve(NearPrimitives::kOctants * NearPrimitives::kPerOctant);
}

void Meetings::look(std::int64_t time_ns) {
  if (fixed_) scene_.emplace(*fixed_, time_ns, recent_);
}

void Meetings::find(const WorldState& state, const PlacedBodies& placed, const SweepAndPrune& near,
                    const MostWays& ways) {
  meetings_.clear();
  dropped_ = 0;
  if (scene_) withScene(state, placed, ways);
  withBodies(state, placed, near, ways);
}

void Meetings::add(const Meeting& meeting) {
  if (meetings_.size() < meetings_.capacity())
    meetings_.push_back(meeting);
  else
    ++dropped_;
}

void Meetings::withScene(const WorldState& state, const PlacedBodies& placed, const MostWays& ways) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    if (state.bodies[i].island != 0) continue;
    Meeting meeting;
    meeting.a = static_cast<int>(i);
    meeting.b = Row::kFixed;
    for (const PlacedConvex& part : placed[i]) {
      partWithScene(meeting, part, ways.to_scene[i] + ways.scenery);
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
    const PlacedConvex primitive = placedOf(id, room);
    if (!findManifold(part, primitive, margin, meeting.manifold)) continue;
    meeting.beside = rolls(part) && isBeside(primitive, meeting.manifold.normal);
    add(meeting);
  }
}

void Meetings::meet(const PlacedBodies& placed, double margin, std::uint32_t a, std::uint32_t b) {
  if (joined_.has(a, b)) return;
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

// What sleeps is the second of a pair.
void Meetings::withBodies(const WorldState& state, const PlacedBodies& placed, const SweepAndPrune& near,
                          const MostWays& ways) {
  const std::size_t first = meetings_.size();
  near.forEachPair(state, ways.bodies, [&](std::uint32_t one, std::uint32_t other) {
    const bool in_order = state.bodies[other].island != 0 || one < other;
    meet(placed, ways.bodies[one] + ways.bodies[other], in_order ? one : other, in_order ? other : one);
  });
  sortFrom(first);
}

void Meetings::sortFrom(std::size_t first) {
  constexpr std::size_t kPlace = 4;
  order_.clear();
  for (std::size_t i = first; i < meetings_.size(); ++i) {
    const Meeting& one = meetings_[i];
    order_.push_back({one.a, one.b, one.part_a, one.part_b, static_cast<int>(i - first)});
  }
  std::sort(order_.begin(), order_.end());
  permute(meetings_.data() + first, order_.size(), [&](std::size_t i) -> int& { return order_[i][kPlace]; });
}

}  // namespace hl
