#include "proxy/proxy.h"

#include <algorithm>

#include "geometry/queries.h"
#include "proxy/contacts.h"
#include "proxy/curvature_step.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

// One tick's work. Kept apart from ProxyState so that a tick leaves nothing behind but the position.
class Tick {
 public:
  Tick(const Snapshot& snapshot, const ProxySettings& settings, const Vec3& finger)
      : snapshot_(snapshot),
        tolerance_(Tolerances::of(settings.radius, snapshot.extent)),
        finger_(finger),
        cap_(settings.iteration_cap) {}

  TickReport run(Vec3& position);

 private:
  SolverResult subGoal(const Vec3& position);
  bool atRest(const Vec3& gap, const Vec3& step) const {
    return step.norm() <= kRestPerGap * gap.norm() + tolerance_.rest;
  }
  bool sweep(Vec3& position, const Vec3& step) const;
  bool tryCurvatureStep(Vec3& position, const SolverResult& sub_goal);
  void restoreIfWorse(Vec3& position);
  void report(const SolverResult& sub_goal, TickReport& report) const;

  const Snapshot& snapshot_;
  const Tolerances tolerance_;
  const Vec3 finger_;
  const int cap_;
  ContactSet set_;

  // A curvature step leaves the surface for a moment: until it has paid off, this is where to return to.
  bool pending_ = false;
  Vec3 checkpoint_ = Vec3::Zero();
  // After the n-th one that did not, the next 2^n sub-goals are plain.
  int refusals_ = 0;
  int plain_left_ = 0;
};

// The paper's sub-goal: the step toward the point nearest the finger above all contact planes.
SolverResult Tick::subGoal(const Vec3& position) {
  gatherContacts(snapshot_, position, tolerance_.touching, tolerance_.reach, set_);
  const Vec3 gap = finger_ - position;
  const std::span<const Plane> planes(set_.planes.begin(), set_.planes.size());
  SolverResult result = nearestAbove(planes, gap, tolerance_.feasible);
  if (result.violation > tolerance_.feasible) {
    relaxToCentre(set_);
    result = nearestAbove(planes, gap, tolerance_.feasible);
    // Held from all sides closer than rounding can tell: stay.
    if (result.violation > tolerance_.feasible) result.point = Vec3::Zero();
  }
  return result;
}

// Moves by `step`, or to the first impact with a primitive that is no contact yet. Returns whether the way was free.
bool Tick::sweep(Vec3& position, const Vec3& step) const {
  const double longest = kSweepPerExtent * (snapshot_.extent + tolerance_.reach);
  const double length = step.norm();
  const bool whole = length <= longest;
  const Vec3 motion = whole ? step : Vec3(step * (longest / length));
  FirstImpact impact;
  if (firstImpact(*snapshot_.index, snapshot_.primitives, position, motion, tolerance_.reach, tolerance_.touching,
                  impact)) {
    position += impact.impact.t * motion;
    return false;
  }
  position += motion;
  return whole;
}

// On a rounded edge or corner the tangent planes alone converge slowly; Newton's step uses the curvature
// (curvature_step.h).
bool Tick::tryCurvatureStep(Vec3& position, const SolverResult& sub_goal) {
  if (pending_ || sub_goal.active_count == 0) return false;
  if (plain_left_ > 0) {
    --plain_left_;
    return false;
  }
  Vec3 step;
  if (!curvatureStep(set_, snapshot_.primitives, sub_goal, tolerance_.reach, step)) return false;
  Vec3 there = position;
  if (!sweep(there, step)) return false;
  pending_ = true;
  checkpoint_ = position;
  position = there;
  return true;
}

// Called with the proxy on the surface again, or at the end: a curvature step that did not bring it nearer is undone.
void Tick::restoreIfWorse(Vec3& position) {
  if (!pending_) return;
  pending_ = false;
  if ((finger_ - position).squaredNorm() < (finger_ - checkpoint_).squaredNorm()) return;
  position = checkpoint_;
  refusals_ = std::min(refusals_ + 1, 10);
  plain_left_ = 1 << refusals_;
}

void Tick::report(const SolverResult& sub_goal, TickReport& report) const {
  for (std::size_t i = 0; i < sub_goal.active_count; ++i) {
    const Contact& contact = set_.contacts[sub_goal.active[i]];
    report.contacts.push({contact.point, contact.plane.normal, sub_goal.multiplier[i], contact.primitive});
  }
}

TickReport Tick::run(Vec3& position) {
  TickReport result;
  while (true) {
    SolverResult sub_goal = subGoal(position);
    if (pending_ && !set_.contacts.empty()) {
      const Vec3 before = position;
      restoreIfWorse(position);
      if (position != before) sub_goal = subGoal(position);
    }
    const bool at_rest = atRest(finger_ - position, sub_goal.point);
    result.capped = !at_rest && (result.iterations >= cap_ || set_.overflow);
    if (at_rest || result.capped) {
      report(sub_goal, result);
      break;
    }
    ++result.iterations;
    if (!tryCurvatureStep(position, sub_goal)) {
      const bool free = set_.contacts.empty();
      // In the open and unhindered the proxy *is* the finger, to the bit.
      if (sweep(position, sub_goal.point) && free) position = finger_;
    }
  }
  restoreIfWorse(position);
  return result;
}

// Pushes a sphere that starts within the scene out of it. Its centre never crosses a surface: each step is swept by the
// largest sphere that is clear of the scene where it starts.
bool findClearPlace(const Snapshot& snapshot, const Tolerances& tolerance, Vec3& position) {
  constexpr int kTries = 100;
  ContactSet set;
  for (int i = 0; i < kTries; ++i) {
    gatherContacts(snapshot, position, tolerance.reach - tolerance.skin, tolerance.reach, set);
    if (set.contacts.empty()) return true;
    double clearance = tolerance.reach;
    for (const Contact& contact : set.contacts) clearance = std::min(clearance, contact.distance);
    const std::span<const Plane> planes(set.planes.begin(), set.planes.size());
    const Vec3 step = nearestAbove(planes, Vec3::Zero(), tolerance.feasible).point;
    FirstImpact impact;
    const double safe = 0.5 * clearance;
    if (safe > 0 && firstImpact(*snapshot.index, snapshot.primitives, position, step, safe, -1, impact)) {
      position += impact.impact.t * step;
    } else {
      position += step;
    }
  }
  return false;
}

}  // namespace

ProxyState startProxy(const Snapshot& snapshot, const ProxySettings& settings, const Vec3& finger) {
  ProxyState state;
  if (!finger.allFinite()) return state;
  state.position = finger;
  state.free = findClearPlace(snapshot, Tolerances::of(settings.radius, snapshot.extent), state.position);
  return state;
}

TickReport tick(ProxyState& state, const Snapshot& snapshot, const ProxySettings& settings, const Vec3& finger) {
  TickReport report;
  if (!finger.allFinite()) {
    report.valid = false;
    return report;
  }
  if (!state.free) state = startProxy(snapshot, settings, finger);
  if (!state.free) {
    report.capped = true;
    return report;
  }
  return Tick(snapshot, settings, finger).run(state.position);
}

}  // namespace hl
