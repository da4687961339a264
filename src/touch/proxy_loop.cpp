#include "touch/proxy_loop.h"

#include <algorithm>

#include "base/clock.h"
#include "base/error.h"
#include "proxy/spring_energy.h"

namespace hl {

void ProxyLoop::follow(const ProxyCommands& commands, const SpringOfServo& spring) {
  workspace_ = commands.workspace;
  settings_.radius = commands.radius_W;
  settings_.surfaces = commands.surfaces;
  settings_.world_per_device = workspace_.world_per_device;
  settings_.spring_N_m = spring.stiffness_N_m;
  settings_.ledger = spring.ledger;
  settings_.period_s = spring.period_s;
}

void ProxyLoop::resume(const ProxyMemory& memory) {
  state_ = memory.state;
  blend_ = TargetBlend(memory.fading);
  last_target_ = memory.last_target;
  restarts_ = memory.restarts;
}

bool ProxyLoop::remember(BodiesMemory& out) const {
  if (bodies_ == nullptr) return true;
  out.held_by = hand_.heldBy();
  return bodies_->remember(out);
}

void ProxyLoop::resume(const BodiesMemory& memory) {
  BodyWorld* const bodies = scenes_.bodies();
  if (bodies == nullptr) throw Error("there is a memory of bodies, and the scene has none");
  bodies->resume(memory);
  hand_.resume(memory.held_by);
}

// The next tick finds where it begins.
void ProxyLoop::restart() {
  const Ledger kept = state_.ledger;
  state_ = {};
  state_.ledger = kept;
}

// In the open the proxy is the finger of a moment ago: pulling to it would be a drag, so there is no pull then. A proxy
// that is still on its way from a surface goes on pulling.
Vec3 ProxyLoop::pullOf(const ProxyState& state, const TickReport& report, const Vec3& finger_D) const {
  if (!touches(state, report)) return Vec3::Zero();
  return state.stiffness * (workspace_.toDevice(state.anchor()) - finger_D);
}

// By how much less the new scene pulls the finger than what came before: the last tick is made once more in the new
// scene, from the same state with the same finger at the same time. So where nothing has changed that it met, nothing
// is different, to the bit. It ends after as many looks, not as much work, which may be other in the new scene; its
// budget, far above that of a tick, only keeps a scene of many triangles from making the loop late.
Vec3 ProxyLoop::changeOfPull(const Snapshot& snapshot) {
  constexpr int kMaxLooks = 64;     // more than a tick makes that is not out of work
  constexpr int kMaxWork = 50'000;  // some 0.25 ms
  ProxySettings settings = settings_;
  settings.work_cap = kMaxWork;
  const int looks = last_.used_up_at > 0 ? last_.used_up_at : kMaxLooks;
  ProxyState again = last_.from;
  const SceneAt scene(snapshot, last_.time_ns, recent_);
  const TickReport report = tick(again, scene, settings, workspace_.toWorld(last_.finger_D), looks);
  return last_.pull_D - pullOf(again, report, last_.finger_D);
}

double ProxyLoop::energyOf_J(const ServoTarget& target, const Vec3& finger_D) const {
  return springEnergy_J(settings_.spring_N_m, target.stiffness, (target.proxy_D - finger_D).squaredNorm());
}

void ProxyLoop::begin(const Snapshot& scene, std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands,
                      const SpringOfServo& spring) {
  follow(commands, spring);
  begun_ = {&scene, now_ns, finger_D, workspace_.toWorld(finger_D), commands.restarts, spring.pulls};
}

ProxyStep ProxyLoop::step(std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands,
                          const SpringOfServo& spring, int most_looks) {
  begin(scenes_.take(), now_ns, finger_D, commands, spring);
  BodyWorld* const bodies = scenes_.bodies();
  HandAtBodies hand;
  if (bodies != nullptr) hand = atBodies();
  body_loop_.step(*begun_.snapshot, bodies, now_ns, settings_.period_s, {&hand, 1});
  return end(bodies, 0, most_looks);
}

// Whether the proxy starts anew. In another scene the pull of the one before fades out.
bool ProxyLoop::startsAnew() {
  const Snapshot& snapshot = *begun_.snapshot;
  const bool anew = state_.snapshot == 0 || begun_.restarts != restarts_;
  restarts_ = begun_.restarts;
  if (anew) {
    restart();
    return true;
  }
  const bool skipped = snapshot.number > state_.snapshot + 1;  // others, with what they changed
  const std::int64_t blend_ns = skipped ? kAbruptBlend_ns : snapshot.blend_ns;
  if (snapshot.number != state_.snapshot && blend_ns > 0) blend_.add(changeOfPull(snapshot), seconds(blend_ns));
  return false;
}

ProxyStep ProxyLoop::end(BodyWorld* bodies, std::size_t hand, int most_looks) {
  bodies_ = bodies;
  if (bodies_ == nullptr) hand_ = {};
  const Begun& now = begun_;
  const SceneAt scene(*now.snapshot, now.time_ns, recent_);
  const bool anew = startsAnew();
  last_.from = state_;
  ProxyStep step;
  step.scene = now.snapshot->identity;
  const Ledger before = state_.ledger;
  step.report = tick(state_, scene, settings_, now.finger, most_looks);
  if (step.report.valid()) step.fields = fieldForces(scene, now.finger);
  if (bodies_ != nullptr)
    hand_.after(*bodies_, hand, scene, state_, step.report, step.fields, settings_, now.finger, now.pulls);
  if (!now.pulls) {
    state_.ledger = before;
    step.report.injected_J = step.report.moved_J = 0;
  }
  if (anew) blend_.add(last_.pull_D - pullOf(state_, step.report, now.finger_D), 1e-9 * kAbruptBlend_ns);
  describe(now.time_ns, now.finger_D, scene, step);
  return step;
}

// What the tick means to the servo and to those who watch.
void ProxyLoop::describe(std::int64_t now_ns, const Vec3& finger_D, const SceneAt& scene, ProxyStep& step) {
  const TickReport& report = step.report;
  for (const ProxyContact& contact : report.contacts) step.touched.push(nameOf(scene.instance(contact.primitive)));
  step.snap = snapOf(scene.snapshot());
  step.held = heldBy(report, targetOf(now_ns, finger_D, report));
  step.held.target.field_N = step.fields.force_N;
  step.held.target.field_drag_Ns_m = step.fields.damping_Ns_m;
  step.held.contacts = feltContacts(scene, settings_, state_, report, workspace_.toWorld(finger_D));
  step.held.held_N = settings_.springInWorld_N_m() * state_.stiffness * report.held_pull_m;
  events_.follow(now_ns, step.touched, state_.position);
}

HoldingSnap ProxyLoop::snapOf(const Snapshot& snapshot) const {
  std::uint32_t number = 0;
  if (!state_.snap.holds() || !snapshot.find(state_.snap.key, number)) return {};
  return {nameOf(snapshot.instances[number]), state_.snap.number};
}

// While a pull fades out, it keeps at least the stiffness that it was made with.
ServoTarget ProxyLoop::targetOf(std::int64_t now_ns, const Vec3& finger_D, const TickReport& report) {
  const bool touching = touches(state_, report);
  const Vec3 pull_D = pullOf(state_, report, finger_D);
  const Vec3 fading_D = blend_.step(settings_.period_s);
  ServoTarget target{finger_D, now_ns, touching, touching ? state_.stiffness : last_target_.stiffness,
                     report.injected_J + std::max(0.0, report.moved_J)};
  if (touching) target.proxy_D = workspace_.toDevice(state_.anchor());
  const double stiffness = last_target_.valid ? std::max(target.stiffness, last_target_.stiffness) : target.stiffness;
  if (blend_.active() && report.valid() && stiffness > 0) {
    target.valid = true;
    target.stiffness = stiffness;
    target.proxy_D = finger_D + (pull_D + fading_D) / stiffness;
    target.paid_J = energyOf_J(target, finger_D) - (last_target_.valid ? energyOf_J(last_target_, finger_D) : 0);
  }
  last_.time_ns = now_ns;
  last_.finger_D = finger_D;
  last_.pull_D = pull_D;
  last_.used_up_at = report.used_up_at;
  return last_target_ = target;
}

// Smooth surfaces let the proxy slide until the next tick; friction, a snap or matter would hold it, so there it stays.
// While a blend goes on, the target is not where the contacts hold the proxy.
HeldContacts ProxyLoop::heldBy(const TickReport& report, const ServoTarget& target) const {
  HeldContacts held;
  held.target = target;
  if (blend_.active() || report.held_pull_m != Vec3::Zero()) return held;
  for (const ProxyContact& contact : report.contacts) {
    if (contact.holds_tangentially) {
      held.planes_D.clear();
      break;
    }
    held.planes_D.push({contact.normal, contact.normal.dot(target.proxy_D)});
  }
  return held;
}

}  // namespace hl
