#include "proxy/follow_deformation.h"

#include <algorithm>

#include "proxy/contact_parts.h"
#include "proxy/element_motion.h"

namespace hl {

namespace {

constexpr double kMaxLift_m = 0.05;  // at the hand
constexpr double kSettling = 4;      // frames in which the lift goes to C F

double largest_N(const ComplianceEstimate& estimate) {
  const auto most = [](const auto& list) { return *std::max_element(list.begin(), list.end()); };
  return std::max({0.0, most(estimate.means_N), most(estimate.lasts_N), estimate.normal.dot(estimate.force_N)});
}

// The motion of the contact's point of the mesh from `from_ns` on, within one transition.
Vec3 displacement(const SceneAt& scene, std::uint32_t number, const ComplianceEstimate& estimate,
                  std::int64_t from_ns) {
  const Instance& instance = scene.snapshot().instances[number];
  const PrimitiveId id{number, estimate.element};
  const MeshTransition* const way = instance.transitionAt(scene.time_ns());
  if (way == nullptr || way != instance.transitionAt(from_ns) || id.element >= way->to()->count()) return Vec3::Zero();
  return scene.turnToWorld(id, displacementOf_O(scene, *way, id, estimate.weights, from_ns, scene.time_ns()));
}

}  // namespace

void followDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  ComplianceEstimate& estimate = state.estimate;
  if (estimate.key == 0) return;
  std::uint32_t number = 0;
  if (!scene.snapshot().find(estimate.key, number) || scene.snapshot().instances[number].compliance) {
    estimate = {};
    return;
  }
  const std::uint64_t geometry = scene.snapshot().instances[number].shape->geometry;
  if (estimate.geometry != geometry && estimate.ticks > 0)
    estimate.closeFrame(settings.period_s, settings.world_per_device / settings.spring_N_m);
  estimate.geometry = geometry;
  if (state.snapshot == scene.snapshot().number) {
    const double moved_m = estimate.normal.dot(displacement(scene, number, estimate, state.time_ns));
    estimate.moved_m += moved_m;
    if (estimate.compliance_m_N > 0) estimate.lift_m -= moved_m * estimate.normal;
  }
  estimate.sum_N += estimate.normal.dot(estimate.force_N);
  ++estimate.ticks;
  if (!(estimate.frame_s > 0)) return;
  const double part = std::min(1.0, settings.period_s / (kSettling * estimate.frame_s));
  estimate.lift_m += part * (estimate.compliance_m_N * estimate.force_N - estimate.lift_m);
  // F_k pushes, and no more than any force that there was.
  const double lift_m = estimate.normal.dot(estimate.lift_m);
  const double most_m = std::min(kMaxLift_m * settings.world_per_device, estimate.compliance_m_N * largest_N(estimate));
  estimate.lift_m += (std::clamp(lift_m, 0.0, most_m) - lift_m) * estimate.normal;
  if (estimate.compliance_m_N == 0) estimate.lift_m = Vec3::Zero();
}

void rememberDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                         const TickReport& report, const Vec3& finger) {
  ComplianceEstimate& estimate = state.estimate;
  estimate.force_N = Vec3::Zero();
  const auto deforms = [&](const ProxyContact& contact) {
    const Instance& instance = scene.instance(contact.primitive);
    const bool may_answer = instance.answers_force && !instance.compliance;
    return may_answer && (instance.mesh_motion || instance.key == estimate.key);
  };
  if (std::none_of(report.contacts.begin(), report.contacts.end(), deforms)) return;
  const ContactParts parts = partsOf(report.contacts, state.anchor() - finger);
  const ProxyContact* hardest = nullptr;
  double most_m = 0;
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    if (!deforms(report.contacts[i]) || !(parts[i].norm() > most_m)) continue;
    most_m = parts[i].norm();
    hardest = &report.contacts[i];
  }
  if (hardest == nullptr || !(state.stiffness > 0)) return;
  const Instance& instance = scene.instance(hardest->primitive);
  if (estimate.key != instance.key) {
    estimate = {};
    estimate.key = instance.key;
    estimate.geometry = instance.shape->geometry;
  }
  // Of the point that is pressed hardest, and all that the mesh holds.
  std::array<bool, kMaxActive> of_mesh{};
  for (std::size_t i = 0; i < report.contacts.size(); ++i)
    of_mesh[i] = report.contacts[i].primitive.instance == hardest->primitive.instance;
  const JointContact mesh = jointContact(report.contacts, parts, of_mesh);
  estimate.element = hardest->primitive.element;
  estimate.weights = hardest->weights;
  estimate.normal = mesh.normal;
  estimate.force_N = settings.springInWorld_N_m() * state.stiffness * mesh.part;
}

}  // namespace hl
