#include "proxy/yielding.h"

#include <algorithm>
#include <optional>

#include "proxy/contact_parts.h"
#include "proxy/mean_stiffness.h"
#include "proxy/surface.h"

namespace hl {

namespace {

// How an object yields, given by its client or estimated.
struct ObjectYielding {
  Compliance compliance;
  std::optional<Vec3> lift_m{};  // C F_k, where it is estimated

  // In the direction of a pull of which the square of the cosine to the normal is `along`.
  double compliance_m_N(double along) const {
    return along * compliance.normal_m_N + (1 - along) * compliance.tangential_m_N;
  }
  // C F_k. Where it would pull, that is no answer of a surface.
  Vec3 lift(double along, const Vec3& normal) const {
    const Vec3 lift = lift_m ? *lift_m : Vec3(compliance_m_N(along) * compliance.computed_for_N);
    return lift - std::min(0.0, normal.dot(lift)) * normal;
  }
};

ObjectYielding yieldingAt(const Instance& instance, std::int64_t time_ns, const ComplianceEstimate& estimate) {
  if (instance.compliance) return {instance.compliance->at(time_ns)};
  if (estimate.key != instance.key) return {};
  return {{estimate.compliance_m_N, estimate.compliance_m_N}, estimate.lift_m};
}

double cosineSquared(const Vec3& pull, const Vec3& normal) {
  const double whole2 = pull.squaredNorm(), along_m = normal.dot(pull);
  return whole2 > 0 ? std::min(1.0, along_m * along_m / whole2) : 1;
}

// 1 / (1 + K s0 C): the part of K s0 that yielding leaves.
double keptOf(double spring_N_m, double compliance_m_N) { return 1 / (1 + spring_N_m * compliance_m_N); }

// Parts of `v`, along the normals and the rest.
void addParts(const Vec3& v, YieldingContacts& contacts) {
  const PartsAlongNormals parts = partsAlongNormals(contacts, v);
  const Vec3 rest = parts.rest / static_cast<double>(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].part_m += parts.along[i] * contacts[i].normal + rest;
}

struct YieldingSpring {
  double stiffness = 1;  // s
  Vec3 rest_offset_m = Vec3::Zero();
};

// The pull is the sum of those of the contacts, s_i (e_i + C_i F_ki), and s their mean; the rest of the spring is where
// s gives this pull. Of one contact it is the proxy, displaced by C F_k.
YieldingSpring springOf(const ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const double spring_N_m = settings.springInWorld_N_m();
  MeanStiffness mean;
  Vec3 whole_m = Vec3::Zero(), pull_m = Vec3::Zero(), lift_m = Vec3::Zero();
  for (const YieldingContact& contact : state.yielding) {
    std::uint32_t number = 0;
    ObjectYielding object;
    if (scene.snapshot().find(contact.key, number))
      object = yieldingAt(scene.snapshot().instances[number], scene.time_ns(), state.estimate);
    const double compliance_m_N = contact.material_m_N + object.compliance_m_N(contact.along);
    const double stiffness = contact.stiffness * keptOf(spring_N_m * contact.stiffness, compliance_m_N);
    lift_m = object.lift(contact.along, contact.normal);
    mean.add(contact.multiplier_m, stiffness);
    whole_m += contact.part_m;
    pull_m += stiffness * (contact.part_m + lift_m);
  }
  const double s = mean.value();
  if (state.yielding.size() == 1 || !(s > 0)) return {s, lift_m};
  return {s, pull_m / s - whole_m};
}

}  // namespace

double yieldingStiffness(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                         const ProxyContact& contact, const Vec3& e) {
  const ObjectYielding object = yieldingAt(scene.instance(contact.primitive), scene.time_ns(), estimate);
  const double compliance_m_N = constantOf(scene, settings.surfaces, contact.primitive, Quantity::kCompliance) +
                                object.compliance_m_N(cosineSquared(e, contact.normal));
  if (!(compliance_m_N > 0)) return contact.stiffness;
  const double spring_N_m = settings.springInWorld_N_m() * contact.stiffness;
  return contact.stiffness * keptOf(spring_N_m, compliance_m_N);
}

void yieldToFrames(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  state.rest_offset_m = Vec3::Zero();
  if (state.yielding.empty()) return;
  const YieldingSpring spring = springOf(state, scene, settings);
  if (!(spring.stiffness > 0 && state.yielding_stiffness > 0)) return;
  state.rest_offset_m = spring.rest_offset_m;
  // What the tick has left of the stiffness, for want of energy, stays the same part of it.
  state.stiffness = std::min(1.0, state.stiffness * (spring.stiffness / state.yielding_stiffness));
  state.yielding_stiffness = spring.stiffness;
}

void rememberYielding(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const TickReport& report,
                      const Vec3& finger) {
  state.yielding.clear();
  const auto yields = [&](const ProxyContact& contact) {
    const Instance& instance = scene.instance(contact.primitive);
    return instance.compliance || state.estimate.key == instance.key ||
           constantOf(scene, settings.surfaces, contact.primitive, Quantity::kCompliance) > 0;
  };
  if (std::none_of(report.contacts.begin(), report.contacts.end(), yields)) return;
  const ContactParts parts = partsOf(report.contacts, state.position + state.rest_offset_m - finger);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const ProxyContact& contact = report.contacts[i];
    state.yielding.push({scene.instance(contact.primitive).key, contact.stiffness,
                         constantOf(scene, settings.surfaces, contact.primitive, Quantity::kCompliance),
                         contact.multiplier_m, cosineSquared(parts[i], contact.normal), parts[i], contact.normal});
  }
  if (state.yielding.size() > 1) addParts(-state.rest_offset_m, state.yielding);
  state.yielding_stiffness = springOf(state, scene, settings).stiffness;
}

}  // namespace hl
