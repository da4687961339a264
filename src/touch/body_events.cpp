#include "touch/body_events.h"

#include <algorithm>

namespace hl {

void BodyEvents::forget() {
  seen_.clear();
  scene_ = 0;
}

// Bodies of the scene before go on.
void BodyEvents::follow(const Snapshot& scene, const BodyWorld& bodies) {
  before_ = seen_;
  seen_.clear();
  const Seen* known = before_.begin();
  std::size_t i = 0;
  for (const Instance& instance : scene.instances) {
    if (!instance.movesAsBody()) continue;
    while (known != before_.end() && known->object.key < instance.key) ++known;
    Seen seen;
    seen.asleep = bodies.state().bodies[i++].island != 0;
    if (known != before_.end() && known->object.key == instance.key) seen = *known;
    seen.object = nameOf(instance);
    seen_.push(seen);
  }
  scene_ = scene.identity;
}

void BodyEvents::begin(const Snapshot& scene, const BodyWorld& bodies) {
  if (scene.identity != scene_) follow(scene, bodies);
  for (std::size_t i = 0; i < seen_.size(); ++i) seen_[i].velocity = bodies.state().bodies[i].velocity;
  returned_ = bodies.view().returned;
}

void BodyEvents::end(std::int64_t now_ns, double period_s, const BodyWorld& bodies) {
  const Vec3 by_gravity_m_s = period_s * bodies.world().gravity_m_s2;
  const double most_m_s = kStruck_m_s + by_gravity_m_s.norm();  // what lies still is held by as much as gravity gives
  const bool returned = bodies.view().returned != returned_;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const BodyState& body = bodies.state().bodies[i];
    Seen& seen = seen_[i];
    const bool asleep = body.island != 0;
    if (asleep != seen.asleep)
      events_.push({asleep ? BodyEventKind::kSleep : BodyEventKind::kWake, now_ns, seen.object, 0, body.centre});
    seen.asleep = asleep;
    const Vec3 given_m_s = returned ? Vec3(Vec3::Zero()) : Vec3(body.velocity - seen.velocity - by_gravity_m_s);
    strike(seen, now_ns, given_m_s, most_m_s, i, bodies);
  }
}

// An impact ends with the first step that gives less, or is reported when it has gone on for long.
void BodyEvents::strike(Seen& seen, std::int64_t now_ns, const Vec3& given_m_s, double most_m_s, std::size_t i,
                        const BodyWorld& bodies) {
  const bool struck = given_m_s.norm() > most_m_s;
  if (struck && !seen.struck) {
    seen.struck_ns = now_ns;
    seen.given_m_s = seen.last_m_s;
  }
  seen.last_m_s = given_m_s;
  if (struck || seen.struck) seen.given_m_s += given_m_s;
  const bool ends = seen.struck && (!struck || now_ns - seen.struck_ns >= kQuiet_ns);
  seen.struck = struck && !ends;
  if (!ends || seen.struck_ns - seen.reported_ns < kQuiet_ns) return;
  seen.reported_ns = seen.struck_ns;
  const double impulse_N_s = bodies.world().bodies[i].mass.mass_kg * seen.given_m_s.norm();
  events_.push({BodyEventKind::kImpact, seen.struck_ns, seen.object, impulse_N_s, bodies.state().bodies[i].centre});
}

}  // namespace hl
