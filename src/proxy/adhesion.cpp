#include "proxy/adhesion.h"

#include <Eigen/QR>
#include <algorithm>

#include "proxy/spring_energy.h"
#include "proxy/surface.h"
#include "proxy/tick.h"
#include "proxy/yielding.h"

namespace hl {

namespace {

constexpr double kFollowing = 0.1;  // radii

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
      if (pull(contact) > room(contact)) continue;
      if (contact.adhesion_N > 0 || pull(contact) > 0) holding_.push(contact);
      if (contact.lift_m > 0) coming_.push(contact);
    }
  }

  TickReport run() {
    TickReport report;
    if (!holding_.empty()) {
      if (tryGoal(alongSurface(), report)) return report;
      if (report.used_up_at > 0) return stay(report);
      if (pulled() && tryGoal(where(), report)) return report;
      if (report.used_up_at > 0) return stay(report);
    }
    return coming_.empty() ? toFinger(report.looks) : withSurface(report.looks);
  }

 private:
  /// m, world: distance of the finger from the proxy along the normal, and the maximum at which the contact holds.
  double pull(const AdheringContact& contact) const { return contact.normal.dot(finger_ - state_.position); }
  double room(const AdheringContact& contact) const { return contact.adhesion_N * world_per_N_ + contact.lift_m; }
  /// m: how far below the surface a goal may be. A surface that only comes after the finger hardly adds to the load.
  double deepest(const AdheringContact& contact) const {
    return contact.adhesion_N > 0 ? settings_.radius : kFollowing * settings_.radius;
  }
  bool pulled() const {
    return std::any_of(holding_.begin(), holding_.end(), [&](const AdheringContact& one) { return pull(one) > 0; });
  }

  Vec3 alongSurface() const {
    Vec3 goal = finger_;
    for (const AdheringContact& contact : holding_) {
      const double above = std::max(0.0, contact.normal.dot(goal - state_.position));
      const double pressed = std::min(room(contact) - std::max(0.0, pull(contact)), deepest(contact));
      goal -= (above + pressed) * contact.normal;
    }
    return goal;
  }
  Vec3 belowSurface() const {
    Vec3 goal = finger_;
    for (const AdheringContact& contact : coming_) goal -= contact.lift_m * contact.normal;
    return goal;
  }
  Vec3 where() const {
    Vec3 goal = state_.position;
    for (const AdheringContact& contact : holding_) goal -= std::min(room(contact), deepest(contact)) * contact.normal;
    return goal;
  }

  bool tryGoal(const Vec3& goal, TickReport& report) {
    ProxyState there = state_;
    report = tickTo(goal, there, report.looks);
    if (adheringOf(scene_, settings_, report).empty()) return false;
    tellOfFinger(there, report);
    const double added_J = energyOf_J(there) - energyOf_J(state_);
    if (added_J > 0) return false;
    take(there, added_J, report);
    return true;
  }

  double energyOf_J(const ProxyState& state) const {
    const Vec3 rest = state.position + state.rest_offset_m;
    const double square_D = ((rest - finger_) / settings_.world_per_device).squaredNorm();
    return springEnergy_J(settings_.spring_N_m, state.stiffness, square_D);
  }

  // Accepts a tick toward another goal, and books its energy.
  void take(ProxyState& there, double added_J, TickReport& report) {
    there.ledger = state_.ledger;
    there.ledger.book(added_J, true);
    report.injected_J = added_J;
    state_ = there;
  }
  // Converts the result of a tick toward another goal to the finger.
  void tellOfFinger(ProxyState& there, TickReport& report) const {
    const Vec3 whole = there.position - finger_;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> normals(3, report.contacts.size());
    for (std::size_t i = 0; i < report.contacts.size(); ++i)
      normals.col(static_cast<Eigen::Index>(i)) = report.contacts[i].normal;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> shares = normals.colPivHouseholderQr().solve(whole);
    for (std::size_t i = 0; i < report.contacts.size(); ++i) {
      report.contacts[i].multiplier_m = shares[static_cast<Eigen::Index>(i)];
      report.contacts[i].rough = true;  // the contact carries the proxy with the object until the next tick
    }
    MeanStiffness surfaces;
    there.rest_offset_m = yieldTo(scene_, settings_, there.estimate, whole, report.contacts, surfaces);
    report.target = finger_ + there.stiffness * (whole + there.rest_offset_m);
  }

  // Report of a tick that does not count: the proxy has not moved.
  TickReport stay(const TickReport& tried) {
    TickReport report;
    report.ending = Ending::kOutOfWork;
    report.work = tried.work;
    report.looks = tried.looks;
    report.used_up_at = tried.used_up_at;
    report.target = finger_ + state_.stiffness * (state_.position + state_.rest_offset_m - finger_);
    return report;
  }

  // To the finger; where that leaves the surface, down to where the surface has gone, if it would come back.
  TickReport withSurface(int looks) {
    ProxyState there = state_;
    const TickReport plain = tickTo(finger_, there, looks);
    TickReport report;
    report.looks = plain.looks;
    const bool leaves = plain.contacts.empty() && plain.used_up_at == 0;
    if (leaves && tryGoal(belowSurface(), report)) return report;
    state_ = there;
    return plain;
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
  AdheringContacts holding_;  // contacts whose adhesion or lift exceeds the pull
  AdheringContacts coming_;   // contacts whose surface comes after the finger
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
    const double lift_m = std::max(0.0, contact.normal.dot(contact.yields.free_m));
    if (adhesion_N > 0 || lift_m > 0) adhering.push({contact.normal, adhesion_N, lift_m});
  }
  return adhering;
}

}  // namespace hl
