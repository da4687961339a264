#include "proxy/yielding.h"

#include <algorithm>
#include <optional>

#include "proxy/surface.h"

namespace hl {

namespace {

using Shares = std::array<double, 3>;

// Shares of the contacts in the part of e that is not along their normals; their sum is 1.
Shares frictionShares(const FixedVector<ProxyContact, 3>& contacts) {
  Shares shares{};
  double sum = 0;
  for (const bool by_friction : {true, false}) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ProxyContact& contact = contacts[i];
      shares[i] = std::max(0.0, contact.multiplier_m) * (by_friction ? contact.static_friction : 1.0);
      sum += shares[i];
    }
    if (sum > 0) break;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
    shares[i] = sum > 0 ? shares[i] / sum : 1.0 / static_cast<double>(contacts.size());
  return shares;
}

// How an object yields, told by its client or estimated.
struct ObjectYielding {
  bool changes = false;  // from frame to frame
  Compliance compliance;
  std::optional<Vec3> lift_m{};  // C F_k, where it is estimated

  // In the direction of a part of e of which the square of the cosine to the normal is `along`.
  double compliance_m_N(double along) const {
    return along * compliance.normal_m_N + (1 - along) * compliance.tangential_m_N;
  }
  Vec3 free_m(double along) const {
    return lift_m ? *lift_m : Vec3(compliance_m_N(along) * compliance.computed_for_N);
  }
};

ObjectYielding yieldingAt(const Instance& instance, std::int64_t time_ns, const ComplianceEstimate& estimate) {
  if (instance.compliance) return {true, instance.compliance->at(time_ns)};
  if (estimate.key != instance.key) return {};
  return {true, {estimate.compliance_m_N, estimate.compliance_m_N}, estimate.lift_m};
}

double ofMaterial_m_N(const SceneAt& scene, const ProxySettings& settings, PrimitiveId id) {
  if (scene.instance(id).plain && !settings.surfaces.compliance_m_N) return 0;
  return Surface(scene, settings.surfaces, id).plain(Quantity::kCompliance);
}

// A surface does not pull, but where it holds the proxy that the finger leaves.
Vec3 pushing(const Vec3& free_m, const ProxyContact& contact) {
  const double out_m = contact.normal.dot(free_m);
  return out_m < 0 && contact.multiplier_m >= 0 ? Vec3(free_m - out_m * contact.normal) : free_m;
}

ContactYields yieldsOf(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                       const ProxyContact& contact, const Vec3& part) {
  const ObjectYielding object = yieldingAt(scene.instance(contact.primitive), scene.time_ns(), estimate);
  const double whole2 = part.squaredNorm();
  ContactYields yields;
  yields.along = whole2 > 0 ? std::min(1.0, contact.multiplier_m * contact.multiplier_m / whole2) : 1;
  yields.spring_N_m = settings.spring_N_m / settings.world_per_device * contact.stiffness;
  yields.compliance_m_N = ofMaterial_m_N(scene, settings, contact.primitive) + object.compliance_m_N(yields.along);
  if (object.changes) yields.free_m = pushing(object.free_m(yields.along), contact);
  return yields;
}

// The part of K s0 that yielding leaves: s / s0.
double keptOf(const ContactYields& yields) { return 1 / (1 + yields.spring_N_m * yields.compliance_m_N); }

}  // namespace

ContactParts partsOf(const FixedVector<ProxyContact, 3>& contacts, const Vec3& e) {
  ContactParts parts;
  Vec3 tangential = e;
  for (const ProxyContact& contact : contacts) tangential -= contact.multiplier_m * contact.normal;
  const Shares shares = frictionShares(contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    parts[i] = contacts[i].multiplier_m * contacts[i].normal + shares[i] * tangential;
  return parts;
}

Vec3 yieldTo(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate, const Vec3& e,
             FixedVector<ProxyContact, 3>& contacts, MeanStiffness& surfaces) {
  const ContactParts parts = partsOf(contacts, e);
  MeanStiffness rigid;  // s0
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ProxyContact& contact = contacts[i];
    contact.yields = yieldsOf(scene, settings, estimate, contact, parts[i]);
    any |= contact.yields.compliance_m_N > 0 || !contact.yields.free_m.isZero(0);
    rigid.add(contact.multiplier_m, contact.stiffness);
    surfaces.add(contact.multiplier_m, contact.stiffness * keptOf(contact.yields));
  }
  if (!any || !(surfaces.value() > 0)) return Vec3::Zero();
  Vec3 rest = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].yields.weight = rigid.value() * keptOf(contacts[i].yields) / surfaces.value();
    rest += pullOf(contacts[i], parts[i], 1);
  }
  return rest - e;
}

void followFrames(ProxyState& state, const SceneAt& scene) {
  double factor = 1;
  for (YieldingContact& contact : state.yielding) {
    std::uint32_t number = 0;
    if (!scene.snapshot().find(contact.key, number)) continue;
    const ObjectYielding object = yieldingAt(scene.snapshot().instances[number], scene.time_ns(), state.estimate);
    ContactYields& yields = contact.yields;
    const ContactYields before = yields;
    yields.compliance_m_N += object.compliance_m_N(yields.along) - contact.object_m_N;
    contact.object_m_N = object.compliance_m_N(yields.along);
    yields.free_m = object.free_m(yields.along);
    state.rest_offset_m += yields.weight * (yields.free_m - before.free_m);
    factor += contact.share * (keptOf(yields) / keptOf(before) - 1);
  }
  if (factor > 0) state.stiffness = std::min(1.0, factor * state.stiffness);
}

YieldingContacts yieldingOf(const SceneAt& scene, const ComplianceEstimate& estimate, const TickReport& report) {
  YieldingContacts all;
  double sum = 0;
  const auto stiffnessOf = [](const ProxyContact& contact) {
    return std::max(0.0, contact.multiplier_m) * contact.stiffness * keptOf(contact.yields);
  };
  for (const ProxyContact& contact : report.contacts) sum += stiffnessOf(contact);
  for (const ProxyContact& contact : report.contacts) {
    const ObjectYielding object = yieldingAt(scene.instance(contact.primitive), scene.time_ns(), estimate);
    if (!object.changes) continue;
    const double share = sum > 0 ? stiffnessOf(contact) / sum : 1.0 / static_cast<double>(report.contacts.size());
    all.push({scene.instance(contact.primitive).key, share, object.compliance_m_N(contact.yields.along),
              contact.yields});
  }
  return all;
}

}  // namespace hl
