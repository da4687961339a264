#include "proxy/yielding.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "proxy/contact_parts.h"
#include "proxy/mean_stiffness.h"
#include "proxy/spring_energy.h"
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

// K s of a contact over K: 1 / (1 / s0 + K C).
double stiffnessOf(const YieldingContact& contact, const ObjectYielding& object, double spring_N_m) {
  const double compliance_m_N = contact.material_m_N + object.compliance_m_N(contact.along);
  return contact.stiffness / (1 + spring_N_m * contact.stiffness * compliance_m_N);
}

// Whether they yield together: shapes of one object, of which its client knows one force.
bool sameObject(const Instance& a, const Instance& b) {
  return a.key == b.key ||
         (a.compliance && b.compliance && a.object != 0 && a.object == b.object && a.session == b.session);
}

double materialOf_m_N(const SceneAt& scene, const ProxySettings& settings, const ProxyContact& contact) {
  return constantOf(scene, settings.surfaces, contact.primitive, Quantity::kCompliance);
}

// The contacts, of which the whole pull is along `e`.
YieldingContacts yieldingOf(const SceneAt& scene, const ProxySettings& settings,
                            const FixedVector<ProxyContact, kMaxActive>& contacts, const Vec3& e) {
  YieldingContacts yielding;
  const ContactParts parts = partsOf(contacts, e);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ProxyContact& contact = contacts[i];
    const Instance& instance = scene.instance(contact.primitive);
    std::array<bool, kMaxActive> of_object{};
    for (std::size_t k = 0; k < contacts.size(); ++k)
      of_object[k] = sameObject(instance, scene.instance(contacts[k].primitive));
    const JointContact object = jointContact(contacts, parts, of_object);
    yielding.push({instance.key, contact.stiffness, materialOf_m_N(scene, settings, contact), contact.multiplier_m,
                   object.shares[i], cosineSquared(object.part, object.normal), parts[i], object.normal});
  }
  return yielding;
}

struct YieldingSpring {
  double stiffness = 1;  // s
  Vec3 lift_m = Vec3::Zero(), sharing_m = Vec3::Zero();
  bool uniform = true;  // all contacts have this s
};

// s is the mean of the contacts. The anchor of the spring is where s gives what they pull together:
//
//   lift      what the meshes press by being computed for F_k: of each object s_i C F_k, to which each of its contacts
//             adds its share; of one object C F_k itself
//   sharing   s_i e_i, the own part of each, in the place of s e; of the stiffness of surfaces the mean s0 stays
YieldingSpring springOf(const ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  MeanStiffness mean, surfaces;
  Vec3 lift_m = Vec3::Zero(), whole_m = Vec3::Zero(), yielded_m = Vec3::Zero();
  for (const YieldingContact& contact : state.yielding.contacts) {
    std::uint32_t number = 0;
    ObjectYielding object;
    if (scene.snapshot().find(contact.key, number))
      object = yieldingAt(scene.snapshot().instances[number], scene.time_ns(), state.estimate);
    const double stiffness = stiffnessOf(contact, object, settings.springInWorld_N_m());
    mean.add(contact.multiplier_m, stiffness);
    surfaces.add(contact.multiplier_m, contact.stiffness);
    lift_m += contact.share * stiffness * object.lift(contact.along, contact.normal);
    whole_m += contact.part_m;
    yielded_m += (contact.stiffness - stiffness) * contact.part_m;
  }
  const double s = mean.value();
  if (!(s > 0)) return {s};
  if (mean.uniform()) return {s, lift_m / s};
  return {s, lift_m / s, (surfaces.value() * whole_m - yielded_m) / s - whole_m, false};
}

}  // namespace

bool anyYields(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
               const FixedVector<ProxyContact, kMaxActive>& contacts) {
  for (const ProxyContact& contact : contacts) {
    const Instance& instance = scene.instance(contact.primitive);
    if (instance.compliance || estimate.key == instance.key || materialOf_m_N(scene, settings, contact) > 0)
      return true;
  }
  return false;
}

MeanStiffness yieldingStiffness(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                                const FixedVector<ProxyContact, kMaxActive>& contacts, const Vec3& e) {
  MeanStiffness mean;
  const YieldingContacts yielding = yieldingOf(scene, settings, contacts, e);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ObjectYielding object = yieldingAt(scene.instance(contacts[i].primitive), scene.time_ns(), estimate);
    mean.add(contacts[i].multiplier_m, stiffnessOf(yielding[i], object, settings.springInWorld_N_m()));
  }
  return mean;
}

double sharePull(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  Yielding& yielding = state.yielding;
  if (yielding.contacts.empty()) return 0;
  const YieldingSpring spring = springOf(state, scene, settings);
  // Where s has changed, what the meshes press by F_k has not: so its lift has, and that is a part of the way.
  const bool changed = !spring.uniform && yielding.stiffness > 0;
  const Vec3 sharing_m =
      changed ? Vec3(yielding.offset_m - yielding.pressed_m / yielding.stiffness) : yielding.sharing_m;
  const Vec3 way = spring.sharing_m - sharing_m;
  yielding.sharing_m = sharing_m;
  if (way.isZero(0)) return 0;
  const double before_J = springEnergy_J(settings, state, finger);
  const double joule_per_square =
      springEnergy_J(settings.spring_N_m, state.stiffness, 1) / (settings.world_per_device * settings.world_per_device);
  const double budget_J = state.ledger.budget_J(settings.ledger);
  const bool free = !(joule_per_square > 0) || !std::isfinite(budget_J);
  const Vec3 e = state.anchor() - finger;
  const Vec3 step = (free ? 1 : partWithin(e, way, budget_J / joule_per_square)) * way;
  yielding.sharing_m += step;
  yielding.offset_m += step;
  const double change_J = springEnergy_J(settings, state, finger) - before_J;
  if (change_J > 0) state.ledger.add(EnergyCause::kStiffness, change_J);
  state.ledger.book(change_J, true);
  return change_J;
}

void yieldToFrames(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  Yielding& yielding = state.yielding;
  if (yielding.contacts.empty()) return yielding.dropOffset();
  const YieldingSpring spring = springOf(state, scene, settings);
  if (!(spring.stiffness > 0 && yielding.stiffness > 0)) return yielding.dropOffset();
  yielding.offset_m = spring.lift_m + yielding.sharing_m;
  yielding.pressed_m = spring.stiffness * spring.lift_m;
  // What the tick has left of the stiffness, for want of energy, stays the same part of it.
  state.stiffness = std::min(1.0, state.stiffness * (spring.stiffness / yielding.stiffness));
  yielding.stiffness = spring.stiffness;
}

void rememberYielding(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const TickReport& report,
                      const Vec3& finger) {
  Yielding& yielding = state.yielding;
  const bool may_yield = report.yields || state.estimate.key != 0;  // the estimate may be newer than the report
  if (!may_yield || !anyYields(scene, settings, state.estimate, report.contacts)) return yielding.contacts.clear();
  yielding.contacts = yieldingOf(scene, settings, report.contacts, state.anchor() - finger);
  if (yielding.contacts.size() > 1) {  // of anchor - finger to those of proxy - finger
    const PartsAlongNormals offset = partsAlongNormals(report.contacts, yielding.offset_m);
    const Vec3 rest = offset.rest / static_cast<double>(report.contacts.size());
    for (std::size_t i = 0; i < report.contacts.size(); ++i)
      yielding.contacts[i].part_m -= offset.along[i] * report.contacts[i].normal + rest;
  }
  yielding.stiffness = springOf(state, scene, settings).stiffness;
}

}  // namespace hl
