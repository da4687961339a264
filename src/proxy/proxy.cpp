#include "proxy/proxy.h"

#include <algorithm>
#include <optional>
#include <span>

#include "base/finger_reach.h"
#include "proxy/account.h"
#include "proxy/back_off.h"
#include "proxy/begin.h"
#include "proxy/carry.h"
#include "proxy/clear_place.h"
#include "proxy/contacts.h"
#include "proxy/curvature_step.h"
#include "proxy/effects.h"
#include "proxy/far_goal.h"
#include "proxy/left_behind.h"
#include "proxy/spring_energy.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

// Steps in a row that come no nearer to the goal. Where they are no longer than planes make them that lean by the skin,
// it is rounding that leads them.
constexpr int kMostIdle = 8;

// Steps in a row above planes of what was left. Where the finger is all but at an edge, each goes a little farther
// around it and away from it; then it is time to come down, and for Newton's step.
constexpr int kMostArounds = 8;

// Steps after a curvature step until it must have paid off: on its way down the proxy may meet another surface first.
constexpr int kMostDescents = 8;

// By how much curvature steps become bolder when one has paid off, and less bold when one has not.
constexpr double kBolder = 4, kMostBoldness = 1024;

// Passes in contact under shading or friction. What is left to slip after so many is slipped in the next tick.
constexpr int kEffectPasses = 8;

// One tick's work. Kept apart from ProxyState so that a tick leaves nothing behind but what its end says.
class Tick {
 public:
  Tick(const SceneAt& scene, const ProxySettings& settings, ProxyState& state, const Vec3& finger)
      : scene_(scene),
        settings_(settings),
        tolerance_(Tolerances::of(settings.radius, scene.extent())),
        finger_(finger),
        far_(kSweepPerExtent * (scene.extent() + tolerance_.reach)),
        goal_(finger),
        state_(state),
        account_(state, settings, finger),
        effects_(scene, settings, tolerance_, state.touching && state.rest_s < kStuck_s, state.creep) {
    state_.surroundings.follow(finger);
  }

  TickReport run();

 private:
  void findContacts() {
    gatherContacts(scene_, state_.position, tolerance_.touching, tolerance_.reach, state_.nearby, set_);
  }
  SubGoal subGoal();
  bool strays(const Vec3& gap) const;
  SubGoal plainSubGoal();
  bool aroundLeft(Vec3& step);
  SubGoal effectSubGoal();
  /// The ways to the goal and to the finger, as far as steps aim.
  Vec3 gap() const { return far_.shortened(goal_ - state_.position); }
  Vec3 fingerGap() const { return far_.shortened(finger_ - state_.position); }
  bool atRest(const Vec3& step) const { return step.norm() <= kRestPerGap * fingerGap().norm() + tolerance_.rest; }
  bool nearer(const Vec3& a, const Vec3& b) const;
  bool slides() const { return !set_.contacts.empty() || around_; }
  bool sweep(Vec3& position, const Vec3& step);
  void fly();
  double likelyWay_m() const;
  bool nearbyTells(const Vec3& from, const Vec3& motion, std::span<const PrimitiveId> contacts, bool& hit,
                   SceneImpact& out);
  bool firstImpact(const Vec3& from, const Vec3& motion, SceneImpact& out);
  void settleOn(const ContactSet& set);
  bool settled() const;
  void aimAt(const Vec3& goal);
  void advance(const SubGoal& sub_goal);
  bool tryCurvatureStep();
  bool restoreIfWorse(bool last);
  void finish(const SubGoal& sub_goal, TickReport& report);

  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Tolerances tolerance_;
  const Vec3 finger_;
  const FarGoal far_;
  Vec3 goal_;  // the finger; after the passes of this tick, where they want the proxy
  ProxyState& state_;
  Account account_;
  Effects effects_;
  ContactSet set_;
  SolverResult plain_;  // of the last plain sub-goal
  bool felt_ = false;   // the sub-goal in hand is under the rules of the surfaces
  bool rests_ = false;  // where the passes have settled on faces: no search could find more
  bool spent_ = false;  // the energy that the tick may add has been used up
  int effect_passes_ = 0;
  double slid_m_ = 0;  // how far the steps since the last touch wanted to go along a surface; 0: the last did not
  FixedVector<Holding, 3> held_by_;  // what has held the proxy last in this tick
  LeftBehind left_;
  bool around_ = false;  // what was left changes the sub-goal in hand
  int arounds_ = 0;      // so many in a row
  // The faces on which the passes have brought the proxy to rest; empty while they have not.
  FixedVector<PrimitiveId, kFewContacts> settled_on_;

  // A curvature step leaves a surface for a moment: until it has paid off, this is where to return to. The steps after
  // it come down, and only then is there something to judge.
  bool pending_ = false;
  int descents_ = 0;  // steps since
  Vec3 checkpoint_ = Vec3::Zero();
  double boldness_ = 1;  // of the next one
  BackOff back_off_;     // from those that do not pay off

  // Where steps have come nearest to this goal, and how many in a row have not come nearer: see advance().
  std::optional<Vec3> nearest_;
  int idle_ = 0;
  bool trembles_ = false;
};

// Whether no step is above all planes, or only one that leads away from the goal by much more than the proxy is below
// them: where planes all but face each other, they cross where rounding says.
bool Tick::strays(const Vec3& gap) const {
  constexpr double kMostPerDepth = 16;
  if (plain_.violation > tolerance_.feasible) return true;
  if (set_.planes.size() < 2) return false;
  double depth = tolerance_.skin;
  for (const Plane& plane : set_.planes) depth = std::max(depth, plane.offset);
  return (gap - plain_.point).norm() > gap.norm() + kMostPerDepth * depth;
}

// The paper's sub-goal: the step toward the point nearest the goal above all contact planes.
SubGoal Tick::plainSubGoal() {
  const Vec3 gap = this->gap();
  const std::span<const Plane> planes(set_.planes.begin(), set_.planes.size());
  plain_ = nearestAbove(planes, gap, tolerance_.feasible);
  if (strays(gap)) {
    relaxToCentre(set_);
    plain_ = nearestAbove(planes, gap, tolerance_.feasible);
    // Held from all sides closer than rounding can tell: stay.
    if (strays(gap)) plain_.point = Vec3::Zero();
  }
  SubGoal result;
  result.step = plain_.point;
  left_.look(set_);
  for (std::size_t i = 0; i < plain_.active_count; ++i) {
    const Contact& contact = set_.contacts[plain_.active[i]];
    result.holding.push({plain_.active[i], placeOf(contact), contact.plane.normal, plain_.multiplier[i]});
    left_.holds(contact.primitive);
  }
  around_ = !left_.empty() && aroundLeft(result.step);
  arounds_ = around_ ? arounds_ + 1 : 0;
  return result;
}

// The step above the planes of what was left behind too. False where they do not count; where it goes so little that it
// is time to come down; and in the open where it is much longer than the way slid since the last touch, as it would
// mostly end at once on something new.
bool Tick::aroundLeft(Vec3& step) {
  constexpr double kLeastPerGap = 1e-5, kMostPerSlid = 2;
  if (pending_ || goal_ != finger_ || arounds_ >= kMostArounds) return false;
  LeftBehind::Planes planes;
  for (const Plane& plane : set_.planes) {
    if (!planes.push(plane)) return false;
  }
  const std::size_t own = planes.size();
  if (left_.addPlanes(scene_, state_.position, tolerance_.reach, planes) == 0) return false;
  const Vec3 gap = this->gap();
  const SolverResult around = nearestAbove({planes.begin(), planes.size()}, gap, tolerance_.feasible);
  const auto* const active_end = around.active.begin() + static_cast<std::ptrdiff_t>(around.active_count);
  const bool counts = std::any_of(around.active.begin(), active_end, [&](std::size_t i) { return i >= own; });
  const double length = around.point.norm();
  if (!counts || around.violation > tolerance_.feasible || length <= kLeastPerGap * gap.norm()) return false;
  if (set_.contacts.empty() && length >= kMostPerSlid * slid_m_) return false;
  left_.holdsStill();
  step = around.point;
  return true;
}

SubGoal Tick::effectSubGoal() {
  ++effect_passes_;
  SubGoal result = effects_.subGoal(set_, state_.position, fingerGap());
  if (!result.bent && !result.resisted) {  // nothing but the true planes after all
    felt_ = false;
    return plainSubGoal();
  }
  if (effect_passes_ > kEffectPasses) result.step = Vec3::Zero();
  if (result.bent && settings_.shading == ShadingPasses::kOnce) aimAt(state_.position + result.step);
  return result;
}

SubGoal Tick::subGoal() {
  settled_on_.clear();
  around_ = false;
  // The once-a-tick goal has been reached, or left behind over an edge: down to the surface, and no farther.
  const bool passes_done = goal_ != finger_;
  if (passes_done && set_.contacts.empty()) aimAt(finger_);
  felt_ = !passes_done && effects_.any(set_);
  SubGoal result = felt_ ? effectSubGoal() : plainSubGoal();
  if (spent_ && !set_.contacts.empty()) result.step = Vec3::Zero();
  return result;
}

// Whether a is nearer to the goal than b, |goal - a| < |goal - b|, however far the goal is: by what lies between them.
bool Tick::nearer(const Vec3& a, const Vec3& b) const {
  const Vec3 apart = a - b;
  return 2 * apart.dot(goal_ - b) > apart.squaredNorm();
}

// Moves by `step`, or to the first impact with a primitive that is no contact yet. Returns whether the way was free.
bool Tick::sweep(Vec3& position, const Vec3& step) {
  const double longest = kSweepPerExtent * (scene_.extent() + tolerance_.reach);
  const double length = step.norm();
  const bool whole = length <= longest;
  const Vec3 motion = whole ? step : Vec3(step * (longest / length));
  SceneImpact impact;
  const bool hit = firstImpact(position, motion, impact);
  const double slid_before_m = set_.contacts.empty() ? slid_m_ : 0;
  slid_m_ = slides() ? slid_before_m + std::min(length, longest) : 0;
  position += hit ? Vec3(impact.impact.t * motion) : motion;
  state_.nearby.endAt(position);
  return whole && !hit;
}

// How far a step mostly goes, which decides nothing but its cost: along a surface as far as it wants; and a proxy that
// has come off a bent surface comes down on it after some hundredths of the way it slid.
double Tick::likelyWay_m() const {
  constexpr double kSlidePerReach = 2, kFallPerSlide = 0.02, kFallPerReach = 0.25;
  if (slides()) return kSlidePerReach * tolerance_.reach;
  return slid_m_ > 0 ? kFallPerSlide * slid_m_ : kFallPerReach * tolerance_.reach;
}

// Asks what is nearby alone. False where that cannot tell: nothing of it is hit on the part of the way that it covers,
// and the way goes on; along a surface it mostly does.
bool Tick::nearbyTells(const Vec3& from, const Vec3& motion, std::span<const PrimitiveId> contacts, bool& hit,
                       SceneImpact& out) {
  Nearby& nearby = state_.nearby;
  if ((!slides() && !nearby.isBall()) || !nearby.covers(scene_, from, tolerance_.touching)) return false;
  const bool whole = nearby.covers(scene_, from + motion, tolerance_.touching) ||
                     (slides() && state_.surroundings.find(scene_, set_, tolerance_, from, motion, nearby));
  const double slack = whole || slides() ? 0 : nearby.slack_m(from, tolerance_.touching);
  if (!whole && slack <= 0) return false;
  const double length = motion.norm();
  const Vec3 to = from + (whole ? 1 : slack / length) * motion;
  FixedVector<PrimitiveId, Nearby::kRoom> met;
  nearby.forEach(from, to, tolerance_.touching + tolerance_.skin, [&](PrimitiveId primitive) {
    if (std::find(contacts.begin(), contacts.end(), primitive) == contacts.end()) met.push(primitive);
  });
  hit = scene_.firstImpactAmong({met.begin(), met.size()}, from, motion, tolerance_.swept, out);
  return whole || (hit && out.impact.t * length <= slack);
}

bool Tick::firstImpact(const Vec3& from, const Vec3& motion, SceneImpact& out) {
  Nearby& nearby = state_.nearby;
  FixedVector<PrimitiveId, Nearby::kRoom> known;
  if (!primitivesOf(set_, known)) {
    nearby.forget();
    return scene_.firstImpact(from, motion, tolerance_.swept, tolerance_.touching, out);
  }
  const std::span<const PrimitiveId> contacts(known.begin(), known.size());
  bool hit = false;
  if (nearbyTells(from, motion, contacts, hit, out)) return hit;
  nearby.begin(scene_, tolerance_.touching);
  return scene_.firstImpact(
      from, motion, tolerance_.swept, tolerance_.touching, likelyWay_m(), contacts,
      [&](PrimitiveId primitive) { nearby.add(primitive); }, out);
}

// On a rounded edge or corner the tangent planes alone converge slowly; Newton's step uses the curvature
// (curvature_step.h).
bool Tick::tryCurvatureStep() {
  if (felt_ || pending_ || around_ || plain_.active_count == 0 || !back_off_.mayTry()) return false;
  Vec3 step;
  if (!curvatureStep(set_, scene_, plain_, tolerance_, boldness_, step)) return false;
  Vec3 there = state_.position;
  // Where something is in the way it may still have gone farther than the plain step would.
  if (!sweep(there, step) && (there - state_.position).norm() <= plain_.point.norm()) return false;
  pending_ = true;
  descents_ = 0;
  checkpoint_ = state_.position;
  state_.position = there;
  return true;
}

// Called after each step that comes down from a curvature step, the last one maybe: one that did not bring the proxy
// nearer is undone. Returns whether it was.
bool Tick::restoreIfWorse(bool last) {
  if (!pending_) return false;
  const bool pays = nearer(state_.position, checkpoint_);
  if (!pays && !last && descents_ < kMostDescents) return false;
  pending_ = false;
  if (pays) {
    boldness_ = std::min(kMostBoldness, boldness_ * kBolder);
    return false;
  }
  boldness_ = std::min(1.0, boldness_) / kBolder;
  const bool moved = state_.position != checkpoint_;
  state_.position = checkpoint_;
  back_off_.failed();
  return moved;
}

// The planes of faces stay what they are when the proxy moves; those of edges and vertices turn.
void Tick::settleOn(const ContactSet& set) {
  for (const Contact& contact : set.contacts) {
    if (contact.feature != Feature::kFace) return settled_on_.clear();
    settled_on_.push(contact.primitive);
  }
}

// Whether the proxy has come where it settles, and nothing but the same faces holds it there: another look would find
// what the last pass found.
bool Tick::settled() const {
  const auto same = [](PrimitiveId primitive, const Contact& contact) {
    return contact.feature == Feature::kFace && contact.primitive == primitive;
  };
  return !settled_on_.empty() &&
         std::equal(settled_on_.begin(), settled_on_.end(), set_.contacts.begin(), set_.contacts.end(), same);
}

// How near steps have come to the goal before says nothing of this one.
void Tick::aimAt(const Vec3& goal) {
  goal_ = goal;
  nearest_.reset();
  idle_ = 0;
  trembles_ = false;
}

// In the open: to the finger, or to what is met first. All that can be met is in a ball about the scene; outside of it
// the proxy is where its way enters the ball, or at the finger at once.
void Tick::fly() {
  const Vec3 from = state_.position, way = finger_ - from;
  const FarGoal::Within ball = far_.within(from, way);
  const bool misses = ball.leave < ball.enter;
  if (!misses && ball.enter > 0) {
    state_.position = from + ball.enter * way;
    return state_.nearby.endAt(state_.position);
  }
  // In the open and unhindered the proxy *is* the finger, to the bit.
  if (misses || sweep(state_.position, ball.leave * way)) state_.nearby.endAt(state_.position = finger_);
}

// One step of the proxy, as far as the way is free and the energy reaches. Planes that all but face each other cross
// where rounding says: there the proxy would go to and fro among a few places for ever.
void Tick::advance(const SubGoal& sub_goal) {
  const Vec3 from = state_.position;
  Vec3 step = sub_goal.step;
  if (sub_goal.bent || sub_goal.creeps || goal_ != finger_) {
    const double part = account_.affordable(from, step);
    spent_ = part < 1;
    step *= part;
  }
  bool whole = false;
  if (slides() || goal_ != finger_) {
    whole = sweep(state_.position, step);
  } else {
    fly();
  }
  ++descents_;
  const bool gains = !nearest_ || nearer(state_.position, *nearest_);
  idle_ = gains ? 0 : idle_ + 1;
  if (gains) nearest_ = state_.position;
  trembles_ = !pending_ && idle_ >= kMostIdle &&
              sub_goal.step.norm() <= tolerance_.lean() * far_.shortened(finger_ - from).norm();
  if (felt_) effects_.moved(sub_goal, state_.position - from);
  if (!sub_goal.settles || !whole || spent_) return;
  rests_ = sub_goal.stays;
  if (rests_) {
    moveContacts(set_, state_.position - from);
  } else {
    settleOn(set_);
  }
}

void Tick::finish(const SubGoal& last, TickReport& report) {
  const bool once = goal_ != finger_;
  goal_ = finger_;
  // After passes made once a tick: what holds the proxy where it has come to rest.
  SubGoal sub_goal = once && !set_.contacts.empty() ? effects_.subGoal(set_, state_.position, fingerGap()) : last;
  // Stopped where the bent planes would let it go on: the true ones hold it.
  if (sub_goal.holding.empty() && !atRest(finger_ - state_.position)) sub_goal = plainSubGoal();
  MeanStiffness surfaces;
  bool stiffness_textured = false;
  for (const Holding& holding : sub_goal.holding) {
    ProxyContact contact = effects_.describe(set_, holding);
    contact.multiplier_m /= far_.part(finger_ - state_.position);
    report.contacts.push(contact);
    surfaces.add(contact.multiplier_m, contact.stiffness);
    stiffness_textured |= effects_.stiffnessTextured(holding.place.primitive);
  }
  const TickEnd end = !sub_goal.holding.empty()           ? TickEnd::kContact
                      : atRest(finger_ - state_.position) ? TickEnd::kOpen
                                                          : TickEnd::kOnItsWay;
  if (end == TickEnd::kOnItsWay) {
    for (const Holding& holding : held_by_) surfaces.add(holding.multiplier_m, effects_.stiffnessAt(holding.place));
  }
  state_.creep = effects_.creep_m();
  state_.rest_s = effects_.hasSlipped() ? 0 : std::min(state_.rest_s + settings_.period_s, kStuck_s);
  account_.close(state_, end, surfaces, {sub_goal.shading, sub_goal.bump, stiffness_textured}, report);
}

TickReport Tick::run() {
  TickReport report;
  SubGoal sub_goal;
  while (true) {
    findContacts();
    const bool settled_there = settled();
    if (!settled_there) sub_goal = subGoal();
    if (pending_ && descents_ > 0 && restoreIfWorse(atRest(sub_goal.step))) {
      findContacts();
      sub_goal = subGoal();
    }
    const bool at_rest = settled_there || trembles_ || (!pending_ && atRest(sub_goal.step));
    report.capped = !at_rest && (report.iterations >= settings_.iteration_cap || set_.overflow);
    if (at_rest || report.capped) break;
    ++report.iterations;
    if (!sub_goal.holding.empty()) held_by_ = sub_goal.holding;
    if (!tryCurvatureStep()) advance(sub_goal);
    if (rests_) break;
  }
  if (restoreIfWorse(true)) {  // what holds it there, not where it has been
    findContacts();
    sub_goal = subGoal();
  }
  finish(sub_goal, report);
  return report;
}

// The part of the next tick that depends on where the proxy has come to rest: the object whose friction holds it.
std::uint64_t carrierOf(const SceneAt& scene, const TickReport& report) {
  double most = 0;
  std::uint64_t key = 0;
  for (const ProxyContact& contact : report.contacts) {
    if (!contact.rough || contact.multiplier_m <= most) continue;
    most = contact.multiplier_m;
    key = scene.instance(contact.primitive).key;
  }
  return key;
}

double energyOf_J(const ProxyState& state, const ProxySettings& settings, const Vec3& finger) {
  const Vec3 gap_D = (state.position - finger) / settings.world_per_device;
  return springEnergy_J(settings.spring_N_m, state.stiffness, gap_D.squaredNorm());
}

// Moving objects do work on the hand; that is theirs, not the rules', and no tank pays for it.
double carryAlong(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  const double before_J = energyOf_J(state, settings, finger);
  carry(state, scene, settings);
  const double moved_J = energyOf_J(state, settings, finger) - before_J;
  if (moved_J > 0) state.ledger.add(EnergyCause::kMoving, moved_J);
  return moved_J;
}

}  // namespace

TickReport tick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  constexpr int kPlacesPerTick = 2;
  TickReport report;
  if (!canBeFinger(finger)) {
    report.valid = false;
    report.target = state.position;
    return report;
  }
  if (!state.free && !beginProxy(state, scene, settings, finger, kPlacesPerTick)) {
    report.placed = false;
    report.target = finger;
    return report;
  }
  const double moved_J = carryAlong(state, scene, settings, finger);
  report = Tick(scene, settings, state, finger).run();
  report.moved_J = moved_J;
  state.time_ns = scene.time_ns();
  state.snapshot = scene.snapshot().number;
  state.carrier = carrierOf(scene, report);
  return report;
}

}  // namespace hl
