#include "proxy/object_forces.h"

#include <algorithm>
#include <array>

namespace hl {

namespace {

using Shares = std::array<double, 3>;

// Shares of the contacts in the force that is not along their normals; their sum is 1.
Shares frictionShares(const TickReport& report) {
  Shares shares{};
  double sum = 0;
  for (const bool by_friction : {true, false}) {
    for (std::size_t i = 0; i < report.contacts.size(); ++i) {
      const ProxyContact& contact = report.contacts[i];
      shares[i] = std::max(0.0, contact.multiplier_m) * (by_friction ? contact.static_friction : 1.0);
      sum += shares[i];
    }
    if (sum > 0) break;
  }
  for (std::size_t i = 0; i < report.contacts.size(); ++i)
    shares[i] = sum > 0 ? shares[i] / sum : 1.0 / static_cast<double>(report.contacts.size());
  return shares;
}

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
  const double spring_N_m = settings.spring_N_m / settings.world_per_device;
  const Vec3 total_N = spring_N_m * (report.target - finger);
  Vec3 tangential_N = total_N;
  const auto normal_N = [&](const ProxyContact& contact) -> Vec3 {
    return spring_N_m * state.stiffness * contact.multiplier_m * contact.normal;
  };
  for (const ProxyContact& contact : report.contacts) tangential_N -= normal_N(contact);
  const Shares shares = frictionShares(report);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const ProxyContact& contact = report.contacts[i];
    add(forces, scene.instance(contact.primitive).key, contact.point, normal_N(contact) + shares[i] * tangential_N);
  }
  if (forces.empty() && total_N != Vec3::Zero()) add(forces, 0, state.position, total_N);
  return forces;
}

}  // namespace hl
