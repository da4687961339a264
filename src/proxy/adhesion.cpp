#include "proxy/adhesion.h"

#include <algorithm>

#include "proxy/adhesion_load.h"
#include "proxy/contact_parts.h"
#include "proxy/goal_tick.h"
#include "proxy/spring_energy.h"
#include "proxy/surface.h"
#include "proxy/tick.h"

namespace hl {

namespace {

class AdheringTick {
 public:
  AdheringTick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
               int most_looks)
      : state_(state),
        scene_(scene),
        settings_(settings),
        finger_(finger),
        most_looks_(most_looks),
        world_per_N_(settings.world_per_device / feltSpring_N_m(settings, state)) {
    for (const AdheringContact& contact : state.adhering) {
      if (pull(contact) <= room(contact)) holding_.push(contact);
    }
  }

  TickReport run() {
    TickReport report;
    if (holding_.empty()) return toFinger(0);
    if (tryGoal(alongSurface(1), report)) return report;
    if (report.used_up_at > 0) return stay(report);
    if (pull_m() > 0 && tryGoal(alongSurface(partOverEdge()), report)) return report;
    if (report.used_up_at > 0) return stay(report);
    if (pull_m() > 0 && tryGoal(where(), report)) return report;
    return report.used_up_at > 0 ? stay(report) : toFinger(report.looks);
  }

 private:
  /// m, world: distance of the finger from the proxy along the normal, and the maximum at which the contact holds.
  double pull(const AdheringContact& contact) const { return contact.normal.dot(finger_ - state_.position); }
  double room(const AdheringContact& contact) const { return contact.adhesion_N * world_per_N_; }
  /// The largest.
  double pull_m() const {
    double most_m = 0;
    for (const AdheringContact& contact : holding_) most_m = std::max(most_m, pull(contact));
    return most_m;
  }
  /// Of the way to the finger: it leads a proxy on an edge or a corner, which are a radius below it, to beneath the
  /// finger; the whole way leads it beyond.
  double partOverEdge() const { return (1 - accuracy::kMaxLowered) * settings_.radius / (settings_.radius + pull_m()); }

  Vec3 alongSurface(double part) {
    Vec3 goal = state_.position + part * (finger_ - state_.position);
    loads_.clear();
    for (const AdheringContact& contact : holding_) {
      const double above = std::max(0.0, contact.normal.dot(goal - state_.position));
      goal -= (above + pressedBy(contact, room(contact) - std::max(0.0, pull(contact)))) * contact.normal;
    }
    return goal;
  }
  Vec3 where() {
    Vec3 goal = state_.position;
    loads_.clear();
    for (const AdheringContact& contact : holding_) goal -= pressedBy(contact, room(contact)) * contact.normal;
    return goal;
  }
  /// By how much the goal is lowered for a load of `whole_m`. The rest acts in friction alone.
  double pressedBy(const AdheringContact& contact, double whole_m) {
    const double lowered_m = std::min(whole_m, accuracy::kMaxLowered * settings_.radius);
    loads_.push({contact.normal, whole_m - lowered_m});
    return lowered_m;
  }

  bool tryGoal(const Vec3& goal, TickReport& report) {
    ProxyState there = state_;
    report = tickTo(goal, there, report.looks, &loads_);
    const double added_J = energyOf_J(there) - energyOf_J(state_);
    if (added_J > 0 || adheringOf(scene_, settings_, report).empty()) return false;
    take(there, added_J, report);
    return true;
  }

  double energyOf_J(const ProxyState& state) const {
    const double square_D = ((state.position - finger_) / settings_.world_per_device).squaredNorm();
    return springEnergy_J(settings_.spring_N_m, state.stiffness, square_D);
  }

  // Accepts a tick toward another goal: books its energy and converts the report from that goal to the finger.
  void take(ProxyState& there, double added_J, TickReport& report) {
    there.ledger = state_.ledger;
    there.ledger.book(added_J, true);
    report.injected_J = added_J;
    state_ = there;
    reportForFinger(report);
  }
  void reportForFinger(TickReport& report) const {
    const Vec3 whole = state_.position - finger_;
    report.target = finger_ + state_.stiffness * whole;
    const PartsAlongNormals parts = partsAlongNormals(report.contacts, whole);
    for (std::size_t i = 0; i < report.contacts.size(); ++i) {
      report.contacts[i].multiplier_m = parts.along[i];
      report.contacts[i].holds_tangentially =
          true;  // the contact carries the proxy with the object until the next tick
    }
  }

  TickReport stay(const TickReport& tried) {
    TickReport report = notCounted(tried, Ending::kOutOfWork);
    report.stayed = true;
    report.target = finger_ + state_.stiffness * (state_.position - finger_);
    return report;
  }

  TickReport toFinger(int looks) { return tickTo(finger_, state_, looks); }

  /// A tick toward `goal`, after `looks` looks of earlier attempts.
  TickReport tickTo(const Vec3& goal, ProxyState& state, int looks, const AdhesionLoads* loads = nullptr) const {
    TickReport report = Tick(scene_, settings_, state, goal, most_looks_ - looks, loads).run();
    report.addEarlierLooks(looks);
    return report;
  }

  ProxyState& state_;
  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Vec3 finger_;
  const int most_looks_;
  const double world_per_N_;
  AdheringContacts holding_;  // contacts whose adhesion exceeds the pull
  AdhesionLoads loads_;       // of the goal that is tried
};

}  // namespace

TickReport tickAdhering(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                        int most_looks) {
  return AdheringTick(state, scene, settings, finger, most_looks).run();
}

AdheringContacts adheringOf(const SceneAt& scene, const ProxySettings& settings, const TickReport& report) {
  AdheringContacts adhering;
  for (const ProxyContact& contact : report.contacts) {
    const double adhesion_N = constantOf(scene, settings.surfaces, contact.primitive, Quantity::kAdhesion);
    if (adhesion_N > 0) adhering.push({contact.normal, adhesion_N});
  }
  return adhering;
}

}  // namespace hl
