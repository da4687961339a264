#include "proxy/yielding.h"

#include <algorithm>

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

// The compliance of one surface.
struct Yielding {
  double material_m_N = 0;  // of its material, for which F_k is 0
  Compliance object;        // told by its client, or estimated
  Vec3 lift_m = Vec3::Zero();  // C F_k, where it is estimated
  bool estimated = false;

  bool rigid() const { return material_m_N == 0 && object.normal_m_N == 0 && object.tangential_m_N == 0; }
  // C in the direction of a part of e of which the square of the cosine to the normal is `along`.
  double object_m_N(double along) const {
    return along * object.normal_m_N + (1 - along) * object.tangential_m_N;
  }
};

Yielding yieldingAt(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                    PrimitiveId id) {
  const Instance& instance = scene.instance(id);
  Yielding yielding;
  if (!instance.plain || settings.surfaces.compliance_m_N)
    yielding.material_m_N = Surface(scene, settings.surfaces, id).plain(Quantity::kCompliance);
  if (instance.compliance) {
    yielding.object = instance.compliance->at(scene.time_ns());
  } else if (estimate.key == instance.key) {
    yielding.object.normal_m_N = yielding.object.tangential_m_N = estimate.compliance_m_N;
    yielding.lift_m = estimate.lift_m;
    yielding.estimated = true;
  }
  return yielding;
}

double squareOf(double x) { return x * x; }

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
  const double spring_N_m = settings.spring_N_m / settings.world_per_device;
  const ContactParts parts = partsOf(contacts, e);
  MeanStiffness rigid;  // s0
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ProxyContact& contact = contacts[i];
    const Yielding yielding = yieldingAt(scene, settings, estimate, contact.primitive);
    const double whole2 = parts[i].squaredNorm();
    const double along = whole2 > 0 ? std::min(1.0, squareOf(contact.multiplier_m) / whole2) : 1;
    const double object_m_N = yielding.object_m_N(along);
    // Of its own stiffness s0 it keeps this.
    const double kept = 1 / (1 + spring_N_m * contact.stiffness * (yielding.material_m_N + object_m_N));
    contact.yields = {kept, along,
                      yielding.estimated ? yielding.lift_m : Vec3(object_m_N * yielding.object.computed_for_N)};
    any |= !yielding.rigid() || contact.yields.free_m != Vec3::Zero();
    rigid.add(contact.multiplier_m, contact.stiffness);
    surfaces.add(contact.multiplier_m, contact.stiffness * kept);
  }
  if (!any || !(surfaces.value() > 0)) return Vec3::Zero();
  const double per_stiffness = rigid.value() / surfaces.value();
  Vec3 rest = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].yields.weight *= per_stiffness;
    rest += pullOf(contacts[i], parts[i], 1);
  }
  return rest - e;
}

void followFrames(ProxyState& state, const SceneAt& scene) {
  const std::vector<Instance>& instances = scene.snapshot().instances;
  for (YieldingContact& contact : state.yielding) {
    const auto found = std::lower_bound(instances.begin(), instances.end(), contact.key,
                                        [](const Instance& one, std::uint64_t key) { return one.key < key; });
    if (found == instances.end() || found->key != contact.key) continue;
    Vec3 free_m = contact.free_m;
    if (found->compliance) {
      const Compliance now = found->compliance->at(scene.time_ns());
      free_m = (contact.along * now.normal_m_N + (1 - contact.along) * now.tangential_m_N) * now.computed_for_N;
    } else if (state.estimate.key == contact.key) {
      free_m = state.estimate.lift_m;
    }
    state.rest_offset_m += contact.weight * (free_m - contact.free_m);
    contact.free_m = free_m;
  }
}

YieldingContacts yieldingOf(const SceneAt& scene, const ComplianceEstimate& estimate, const TickReport& report) {
  YieldingContacts all;
  for (const ProxyContact& contact : report.contacts) {
    const Instance& instance = scene.instance(contact.primitive);
    if (!instance.compliance && estimate.key != instance.key) continue;
    all.push({instance.key, contact.yields.weight, contact.yields.along, contact.yields.free_m});
  }
  return all;
}

}  // namespace hl
