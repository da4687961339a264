#include "proxy/adhesion.h"

#include <Eigen/QR>
#include <algorithm>

#include "proxy/goal_tick.h"
#include "proxy/spring_energy.h"
#include "proxy/surface.h"
#include "proxy/tick.h"

namespace hl {

namespace {

double adhesionOf_N(const SceneAt& scene, const ProxySettings& settings, PrimitiveId id) {
  if (scene.instance(id).plain && !settings.surfaces.adhesion_N) return 0;
  return Surface(scene, settings.surfaces, id).plain(Quantity::kAdhesion);
}

class HeldTick {
 public:
  HeldTick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger, int most_looks)
      : state_(state),
        scene_(scene),
        settings_(settings),
        finger_(finger),
        most_looks_(most_looks),
        world_per_N_(settings.world_per_device / (settings.spring_N_m * state.stiffness)) {
    for (const AdheringContact& contact : state.adhering) {
      if (pull(contact) <= room(contact)) holding_.push(contact);
    }
  }

  TickReport run() {
    TickReport report;
    if (holding_.empty()) return toFinger(0);
    if (tryGoal(alongSurface(), report)) return report;
    if (report.used_up_at > 0) return stay(report);
    if (pulled() && tryGoal(where(), report)) return report;
    return report.used_up_at > 0 ? stay(report) : toFinger(report.looks);
  }

 private:
  /// m, world: distance of the finger from the proxy along the normal, and the maximum at which the contact holds.
  double pull(const AdheringContact& contact) const { return contact.normal.dot(finger_ - state_.position); }
  double room(const AdheringContact& contact) const { return contact.adhesion_N * world_per_N_; }
  bool pulled() const {
    return std::any_of(holding_.begin(), holding_.end(), [&](const AdheringContact& one) { return pull(one) > 0; });
  }

  Vec3 alongSurface() const {
    Vec3 goal = finger_;
    for (const AdheringContact& contact : holding_) {
      const double above = std::max(0.0, contact.normal.dot(goal - state_.position));
      const double pressed = std::min(room(contact) - std::max(0.0, pull(contact)), settings_.radius);
      goal -= (above + pressed) * contact.normal;
    }
    return goal;
  }
  Vec3 where() const {
    Vec3 goal = state_.position;
    for (const AdheringContact& contact : holding_) goal -= std::min(room(contact), settings_.radius) * contact.normal;
    return goal;
  }

  bool tryGoal(const Vec3& goal, TickReport& report) {
    ProxyState there = state_;
    report = tickTo(goal, there, report.looks);
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
    tellOfFinger(report);
  }
  void tellOfFinger(TickReport& report) const {
    const Vec3 whole = state_.position - finger_;
    report.target = finger_ + state_.stiffness * whole;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> normals(3, report.contacts.size());
    for (std::size_t i = 0; i < report.contacts.size(); ++i)
      normals.col(static_cast<Eigen::Index>(i)) = report.contacts[i].normal;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> shares = normals.colPivHouseholderQr().solve(whole);
    for (std::size_t i = 0; i < report.contacts.size(); ++i) {
      report.contacts[i].multiplier_m = shares[static_cast<Eigen::Index>(i)];
      report.contacts[i].rough = true;  // the contact carries the proxy with the object until the next tick
    }
  }

  TickReport stay(const TickReport& tried) {
    TickReport report = notCounted(tried, Ending::kOutOfWork);
    report.target = finger_ + state_.stiffness * (state_.position - finger_);
    return report;
  }

  TickReport toFinger(int looks) { return tickTo(finger_, state_, looks); }

  /// A tick toward `goal`, after `looks` looks of earlier attempts.
  TickReport tickTo(const Vec3& goal, ProxyState& state, int looks) const {
    TickReport report = Tick(scene_, settings_, state, goal, most_looks_ - looks).run();
    report.looks += looks;
    if (report.used_up_at > 0) report.used_up_at += looks;
    return report;
  }

  ProxyState& state_;
  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Vec3 finger_;
  const int most_looks_;
  const double world_per_N_;
  AdheringContacts holding_;  // contacts whose adhesion exceeds the pull
};

}  // namespace

TickReport tickHeld(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                    int most_looks) {
  return HeldTick(state, scene, settings, finger, most_looks).run();
}

AdheringContacts adheringOf(const SceneAt& scene, const ProxySettings& settings, const TickReport& report) {
  AdheringContacts adhering;
  for (const ProxyContact& contact : report.contacts) {
    const double adhesion_N = adhesionOf_N(scene, settings, contact.primitive);
    if (adhesion_N > 0) adhering.push({contact.normal, adhesion_N});
  }
  return adhering;
}

}  // namespace hl
