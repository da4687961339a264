#include "proxy/carry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/queries.h"
#include "proxy/clear_place.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

class Carry {
 public:
  Carry(ProxyState& state, const Snapshot& snapshot, const ProxySettings& settings, std::int64_t end_ns)
      : state_(state),
        snapshot_(snapshot),
        tolerance_(Tolerances::of(settings.radius, snapshot.extent)),
        now_ns_(state.time_ns),
        end_ns_(end_ns),
        leader_(carrierOf(state)) {}

  void run() {
    for (int left = convergence::kMostCarrySteps; left > 0 && now_ns_ < end_ns_; --left)
      bendsNear() ? creep(left) : step(left);
    if (now_ns_ < end_ns_) advance(end_ns_);
  }

 private:
  struct Meeting {
    double part = 2;  // of the time until then; above 1: none
    std::uint32_t instance = kNone;
  };

  std::uint32_t carrierOf(const ProxyState& state) const {
    const auto& all = snapshot_.instances;
    const auto found = std::lower_bound(all.begin(), all.end(), state.carrier,
                                        [](const Instance& a, std::uint64_t key) { return a.key < key; });
    if (state.carrier == 0 || found == all.end() || found->key != state.carrier) return kNone;
    if (!found->motion.moves() && !found->bending) return kNone;
    return static_cast<std::uint32_t>(found - all.begin());
  }

  template <typename Visit>
  void forEachNear(const Vec3& a, const Vec3& b, Visit visit) const;
  void step(int left);
  void creep(int left);
  void advance(std::int64_t time_ns);
  void pushOut();
  Vec3 carriedTo(std::int64_t time_ns) const;
  Vec3 bentTo(const BendWay& way, std::int64_t time_ns) const;
  bool bendsNear() const;
  std::int64_t oneWayUntil() const;
  double wayOf_m(const Instance& instance, std::int64_t until_ns, double clearance) const;
  double partUntilBent(const Instance& instance, std::int64_t until_ns, double way_m) const;
  std::int64_t straightUntil() const;
  Meeting firstMeeting(std::int64_t until_ns, const Vec3& goal) const;

  ProxyState& state_;
  const Snapshot& snapshot_;
  const Tolerances tolerance_;
  std::int64_t now_ns_;
  const std::int64_t end_ns_;
  std::uint32_t leader_;  // the object that takes the proxy along
};

// Visits the objects whose reach comes near the way from a to b.
template <typename Visit>
void Carry::forEachNear(const Vec3& a, const Vec3& b, Visit visit) const {
  const Vec3 margin = Vec3::Constant(convergence::kNearPerReach * tolerance_.reach);
  const Box region{a.cwiseMin(b) - margin, a.cwiseMax(b) + margin};
  snapshot_.near.visitMet(region, [&](std::uint32_t i) { visit(i, snapshot_.instances[i]); });
}

// Where the leader takes the proxy by then.
Vec3 Carry::carriedTo(std::int64_t time_ns) const {
  if (leader_ == kNone) return state_.position;
  const Instance& leader = snapshot_.instances[leader_];
  const Motion& motion = leader.motion;
  Vec3 place = motion.at(now_ns_).toObject(state_.position);
  if (const BendWay* const way = leader.bentAt(now_ns_)) place += bentTo(*way, time_ns);
  return motion.at(time_ns).toWorld(place);
}

// How far the place of the leader nearest to the proxy goes by then, as its mesh bends; frame of the leader. Nothing
// where it does not touch the proxy.
Vec3 Carry::bentTo(const BendWay& way, std::int64_t time_ns) const {
  const SceneAt scene(snapshot_, now_ns_);
  ClosestPoint nearest;
  PrimitiveId held{kNone, 0};
  scene.primitivesWithin(
      state_.position, accuracy::kTouchingBend * tolerance_.reach, [&](PrimitiveId id, const ClosestPoint& place) {
        if (id.instance != leader_) return;
        if (held.instance != kNone && place.distance > nearest.distance) return;
        if (held.instance != kNone && place.distance == nearest.distance && !scene.precedes(id, held)) return;
        held = id;
        nearest = place;
      });
  if (held.instance == kNone) return Vec3::Zero();
  const Primitive touched = scene.primitive(held);
  if (touched.kind != way.to()->primitives.elementKind(held.element)) return Vec3::Zero();  // it has shrunk
  const auto now = way.corners(held.element, way.part(now_ns_)), then = way.corners(held.element, way.part(time_ns));
  Vec3 gone = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) gone += nearest.weights[i] * (then[touched.order[i]] - now[touched.order[i]]);
  return gone;
}

// Whether a mesh that bends may come near the proxy, or the way on which it is taken along.
bool Carry::bendsNear() const {
  if (now_ns_ >= snapshot_.bends_until_ns) return false;
  const Vec3 to = carriedTo(end_ns_), margin = Vec3::Constant(convergence::kNearPerReach * tolerance_.reach);
  const Box region{state_.position.cwiseMin(to) - margin, state_.position.cwiseMax(to) + margin};
  return std::any_of(snapshot_.bent.begin(), snapshot_.bent.end(), [&](std::uint32_t i) {
    return snapshot_.instances[i].bentAt(now_ns_) != nullptr && snapshot_.reach[i].meets(region);
  });
}

// Until when each object nearby stays on one screw and turns little enough for a straight sweep.
std::int64_t Carry::straightUntil() const {
  std::int64_t until_ns = end_ns_;
  forEachNear(state_.position, state_.position, [&](std::uint32_t, const Instance& instance) {
    const Motion& motion = instance.motion;
    const bool earlier = now_ns_ < motion.last().begin_ns();
    const Screw& screw = earlier ? motion.earlier() : motion.last();
    if (earlier && motion.moves()) until_ns = std::min(until_ns, motion.last().begin_ns());
    if (!screw.moves() || screw.angle() == 0) return;
    const double way_ns =
        accuracy::kMostTurn_rad / screw.angle() * static_cast<double>(screw.end_ns() - screw.begin_ns());
    if (way_ns < static_cast<double>(until_ns - now_ns_))
      until_ns = now_ns_ + std::max<std::int64_t>(1, static_cast<std::int64_t>(way_ns));
  });
  return until_ns;
}

Carry::Meeting Carry::firstMeeting(std::int64_t until_ns, const Vec3& goal) const {
  Meeting first;
  forEachNear(state_.position, goal, [&](std::uint32_t i, const Instance& instance) {
    if (i == leader_ || (!instance.motion.moves() && leader_ == kNone)) return;
    const Vec3 from = instance.motion.at(now_ns_).toObject(state_.position);
    const Vec3 to = instance.motion.at(until_ns).toObject(goal);
    const Shape& shape = *instance.shape;
    FirstImpact hit;
    if (!firstImpact(*shape.index, shape.primitives, from, to - from, accuracy::kMetAt * tolerance_.reach, -1, hit))
      return;
    if (hit.impact.t < first.part || (hit.impact.t == first.part && i < first.instance)) first = {hit.impact.t, i};
  });
  return first;
}

void Carry::advance(std::int64_t time_ns) {
  state_.position = carriedTo(time_ns);
  now_ns_ = time_ns;
  pushOut();
}

// Where there is no room for the proxy, to the roomiest place that it finds by looking for room for all of it, for half
// of it, for a quarter, and so on: pinched, its centre keeps away from all that closes in.
void Carry::pushOut() {
  const SceneAt scene(snapshot_, now_ns_);
  const Vec3 from = state_.position;
  double roomiest = 0;
  Tolerances smaller = tolerance_;
  for (int i = 0; i <= accuracy::kPinchHalvings && roomiest < smaller.reach; ++i, smaller.reach /= 2) {
    Vec3 place = from;
    const bool clear =
        findClearPlace(scene, smaller, i == 0 ? convergence::kPushTries : convergence::kPinchedTries, place);
    const double room = clear && i == 0 ? tolerance_.reach : clearanceAt(scene, place, tolerance_.reach);
    if (room <= roomiest) continue;
    roomiest = room;
    state_.position = place;
  }
}

void Carry::step(int left) {
  const std::int64_t until_ns = straightUntil();
  const Meeting meeting = firstMeeting(until_ns, carriedTo(until_ns));
  if (meeting.part > 1) return advance(until_ns);
  const auto way_ns = static_cast<double>(until_ns - now_ns_);
  const auto before_ns = static_cast<std::int64_t>(std::floor(meeting.part * way_ns));
  if (before_ns > 0) advance(now_ns_ + before_ns);
  if (leader_ == kNone && snapshot_.instances[meeting.instance].motion.moves()) {
    leader_ = meeting.instance;
  } else {
    leader_ = kNone;
    creep(left);
  }
}

// Until when each mesh that bends is on one way.
std::int64_t Carry::oneWayUntil() const {
  std::int64_t until_ns = end_ns_;
  for (const std::uint32_t i : snapshot_.bent) {
    const std::int64_t next_ns = snapshot_.instances[i].bending->last().begin_ns();
    if (now_ns_ < next_ns) until_ns = std::min(until_ns, next_ns);
  }
  return until_ns;
}

// How far an object moves past the proxy until then, at most, not counting how it bends.
double Carry::wayOf_m(const Instance& instance, std::int64_t until_ns, double clearance) const {
  const Motion& motion = instance.motion;
  if (!motion.moves()) return 0;
  const Pose now = motion.at(now_ns_), end = motion.at(until_ns);
  const double turn = (end.rotation - now.rotation).norm();
  const double slide = (end.toWorld(now.toObject(state_.position)) - state_.position).norm();
  return convergence::kArcPerChord * (slide + turn * clearance);
}

// The part of the time until then in which nothing of a bending mesh takes more than kCloseIn of its distance from the
// proxy's centre, when all of the mesh also moves by `way_m` past it. What never comes nearer than half a radius on its
// way need not be looked at.
double Carry::partUntilBent(const Instance& instance, std::int64_t until_ns, double way_m) const {
  const BendWay* const way = instance.bentAt(now_ns_);
  if (way == nullptr) return 1;
  const double begin = way->part(now_ns_), end = way->part(until_ns);
  const Vec3 place = instance.motion.at(now_ns_).toObject(state_.position);
  double part = 1;
  way->index(begin, end)
      .overlap(place, (1 - convergence::kCloseIn) * tolerance_.reach + way_m, [&](std::uint32_t primitive) {
        const double distance = closestPoint(way->primitive(primitive, begin), place).distance;
        const double most = (end - begin) * way->length_m(primitive) + way_m;
        if (convergence::kCloseIn * distance < part * most) part = convergence::kCloseIn * distance / most;
      });
  return part;
}

// Between two objects that close in, or with meshes that bend: a little at a time, and each time out of all.
void Carry::creep(int left) {
  const std::int64_t until_ns = oneWayUntil();
  const auto left_ns = static_cast<double>(until_ns - now_ns_);
  if (!(left_ns > 0)) return;
  const double clearance = clearanceAt({snapshot_, now_ns_}, state_.position, tolerance_.reach);
  const Vec3 carried = carriedTo(until_ns);
  const double carried_m = (carried - state_.position).norm();
  double part = carried_m > 0 ? std::min(1.0, convergence::kCloseIn * clearance / carried_m) : 1;
  forEachNear(state_.position, carried, [&](std::uint32_t, const Instance& instance) {
    const double way_m = wayOf_m(instance, until_ns, clearance) + carried_m;
    if (way_m > 0) part = std::min(part, convergence::kCloseIn * clearance / way_m);
    part = std::min(part, partUntilBent(instance, until_ns, way_m));
  });
  part = std::max(part, 1.0 / left);
  advance(now_ns_ + std::max<std::int64_t>(1, static_cast<std::int64_t>(part * left_ns)));
}

}  // namespace

void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const Snapshot& snapshot = scene.snapshot();
  if (state.time_ns < snapshot.moves_until_ns && state.time_ns < scene.time_ns())
    Carry(state, snapshot, settings, scene.time_ns()).run();
}

}  // namespace hl
