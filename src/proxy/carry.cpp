#include "proxy/carry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/queries.h"
#include "proxy/clear_place.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

// In an object's frame the way of the proxy is taken for straight. It strays from that by R q^2 / 8 at a turn of q; at
// this turn by 1/200 of its distance R from the axis.
constexpr double kMostTurn_rad = 0.2;

// Part of the clearance by which objects may close in on the proxy before it is pushed out again.
constexpr double kCloseIn = 0.5;
constexpr double kArcPerChord = 1.1;  // of a turn of at most kMostTurn_rad, with room to spare

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
    for (int left = kMostCarrySteps; left > 0 && now_ns_ < end_ns_; --left) step(left);
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
    if (state.carrier == 0 || found == all.end() || found->key != state.carrier || !found->motion.moves()) return kNone;
    return static_cast<std::uint32_t>(found - all.begin());
  }

  template <typename Visit>
  void forEachNear(const Vec3& a, const Vec3& b, Visit visit) const;
  void step(int left);
  void creep(int left);
  void advance(std::int64_t time_ns);
  Vec3 carriedTo(std::int64_t time_ns) const;
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
  const Vec3 margin = Vec3::Constant(2 * tolerance_.reach);
  const Box region{a.cwiseMin(b) - margin, a.cwiseMax(b) + margin};
  snapshot_.near.visitMet(region, [&](std::uint32_t i) { visit(i, snapshot_.instances[i]); });
}

// Where the leader takes the proxy by then.
Vec3 Carry::carriedTo(std::int64_t time_ns) const {
  if (leader_ == kNone) return state_.position;
  const Motion& motion = snapshot_.instances[leader_].motion;
  return motion.at(time_ns).toWorld(motion.at(now_ns_).toObject(state_.position));
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
    const double way_ns = kMostTurn_rad / screw.angle() * static_cast<double>(screw.end_ns() - screw.begin_ns());
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
    if (!firstImpact(*shape.index, shape.primitives, from, to - from, kMetAt * tolerance_.reach, -1, hit)) return;
    if (hit.impact.t < first.part || (hit.impact.t == first.part && i < first.instance)) first = {hit.impact.t, i};
  });
  return first;
}

void Carry::advance(std::int64_t time_ns) {
  state_.position = carriedTo(time_ns);
  now_ns_ = time_ns;
  findClearPlace({snapshot_, now_ns_}, tolerance_, kPushTries, state_.position);
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

// Between two objects that close in: a little at a time, and each time out of both.
void Carry::creep(int left) {
  const auto left_ns = static_cast<double>(end_ns_ - now_ns_);
  if (!(left_ns > 0)) return;
  const double clearance = clearanceAt({snapshot_, now_ns_}, state_.position, tolerance_.reach);
  double way = 0;
  forEachNear(state_.position, state_.position, [&](std::uint32_t, const Instance& instance) {
    const Motion& motion = instance.motion;
    if (!motion.moves()) return;
    const Pose now = motion.at(now_ns_), end = motion.at(end_ns_);
    const double turn = (end.rotation - now.rotation).norm();
    const double slide = (end.toWorld(now.toObject(state_.position)) - state_.position).norm();
    way = std::max(way, kArcPerChord * (slide + turn * clearance));
  });
  const double part = std::max(way > 0 ? kCloseIn * clearance / way : 1, 1.0 / left);
  advance(now_ns_ + std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(part, 1.0) * left_ns)));
}

}  // namespace

void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const Snapshot& snapshot = scene.snapshot();
  if (state.time_ns < snapshot.moves_until_ns && state.time_ns < scene.time_ns())
    Carry(state, snapshot, settings, scene.time_ns()).run();
}

}  // namespace hl
