#include "server/proxy_loop.h"

#include <algorithm>

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

ProxyStep ProxyLoop::step(std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands,
                          const SpringOfServo& spring) {
  follow(commands, spring);
  const Snapshot& snapshot = scenes_.take();
  const SceneAt scene(snapshot, now_ns, recent_);
  const Vec3 finger = workspace_.toWorld(finger_D);
  const bool restart = state_.snapshot == 0 || commands.restarts != restarts_;
  std::int64_t blend_ns = snapshot.number == state_.snapshot ? 0 : snapshot.blend_ns;
  if (snapshot.number > state_.snapshot + 1) blend_ns = kAbruptBlend_ns;  // others were skipped, with what they changed
  if (restart) {
    blend_ns = kAbruptBlend_ns;
    const Ledger kept = state_.ledger;
    state_ = {};  // the tick finds where it begins
    state_.ledger = kept;
  }
  restarts_ = commands.restarts;
  ProxyStep step;
  step.scene = snapshot.identity;
  step.report = tick(state_, scene, settings_, finger);
  for (const ProxyContact& contact : step.report.contacts) {
    const Instance& instance = scene.instance(contact.primitive);
    step.touched.push({instance.key, instance.session, instance.object, instance.name});
  }
  step.held = heldBy(step.report, targetOf(now_ns, finger_D, step.report, blend_ns));
  events_.follow(now_ns, step.touched, state_.position);
  return step;
}

// In the open the proxy is the finger of a moment ago: pulling to it would be a drag, so there is no target then, but
// while a blend lets go. A proxy that is still on its way from a surface goes on pulling.
ServoTarget ProxyLoop::targetOf(std::int64_t now_ns, const Vec3& finger_D, const TickReport& report,
                                std::int64_t blend_ns) {
  const bool touches = report.valid && state_.free && state_.touching;
  const Vec3 wanted = touches ? workspace_.toDevice(state_.position) : finger_D;
  const Vec3 before = pulled_ ? blend_.last() : finger_D;
  if (blend_ns > 0 && report.valid) blend_.begin(before, wanted, 1e-9 * static_cast<double>(blend_ns));
  const Vec3 proxy_D = blend_.step(wanted, settings_.period_s);
  const double stiffness = touches ? state_.stiffness : last_stiffness_;
  double paid_J = report.injected_J + std::max(0.0, report.moved_J);
  if (blend_.active()) {
    paid_J = springEnergy_J(settings_.spring_N_m, stiffness, (proxy_D - finger_D).squaredNorm()) -
             springEnergy_J(settings_.spring_N_m, last_stiffness_, (before - finger_D).squaredNorm());
  }
  pulled_ = touches || (blend_.active() && report.valid);
  last_stiffness_ = stiffness;
  return {proxy_D, now_ns, pulled_, stiffness, paid_J};
}

// Smooth surfaces let the proxy slide until the next tick; friction would hold it, so there it stays. While a blend
// goes on, the target is not where the contacts hold the proxy.
HeldContacts ProxyLoop::heldBy(const TickReport& report, const ServoTarget& target) const {
  HeldContacts held;
  held.target = target;
  if (blend_.active()) return held;
  for (const ProxyContact& contact : report.contacts) {
    if (contact.rough) {
      held.planes_D.clear();
      break;
    }
    held.planes_D.push({contact.normal, contact.normal.dot(target.proxy_D)});
  }
  return held;
}

}  // namespace hl
