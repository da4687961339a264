#include "proxy/object_forces.h"

#include <algorithm>

#include "proxy/contact_parts.h"

namespace hl {

namespace {

void add(ObjectForces& forces, std::uint64_t key, const Vec3& point, const Vec3& force_N) {
  const auto known = std::find_if(forces.begin(), forces.end(), [&](const ObjectForce& one) { return one.key == key; });
  if (known == forces.end()) {
    forces.push({key, point, force_N});
  } else {
    known->force_N += force_N;
  }
}

}  // namespace

ObjectForces objectForces(const SceneAt& scene, const ProxySettings& settings, const ProxyState& state,
                          const TickReport& report, const Vec3& finger) {
  ObjectForces forces;
  const double spring_N_m = settings.springInWorld_N_m();
  const Vec3 total_N = spring_N_m * (report.target - finger);
  const ContactParts by_contacts_N = contactForces_N(settings, state, report, finger);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const ProxyContact& contact = report.contacts[i];
    add(forces, scene.instance(contact.primitive).key, contact.point, by_contacts_N[i]);
  }
  if (state.snap.holds())
    forces.push({state.snap.key, report.snap_point, spring_N_m * state.stiffness * report.held_pull_m});
  if (!state.snap.holds() && !forces.empty() && report.held_pull_m != Vec3::Zero())
    add(forces, 0, state.position, spring_N_m * state.stiffness * report.held_pull_m);
  if (forces.empty() && total_N != Vec3::Zero()) add(forces, 0, state.position, total_N);
  return forces;
}

}  // namespace hl
