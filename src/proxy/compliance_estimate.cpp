#include "proxy/compliance_estimate.h"

#include <algorithm>
#include <array>

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "proxy/yielding.h"
#include "scene/scene_at.h"

namespace hl {

namespace {

constexpr double kRoundUp = 1.25;
constexpr double kMaxEstimate_m_N = 0.05;  // 20 N/m: softer than any tissue that is pressed
constexpr std::size_t kMaxLag = 4;         // frames from a force to the end of the motion that answers it
constexpr double kLeastChange_N = 0.01;    // root of the summed squares; less tells nothing
constexpr double kLeastExplained = 0.8;    // r^2 of the secant
constexpr double kLeast_m_N = 1e-5;        // 100 kN/m: nothing
constexpr double kDecay = 0.25;            // of an estimate that is too high, in a frame
constexpr double kSettling = 4;            // frames in which the lift goes to C F

// Sums over pairs (change of force, motion of the mesh).
struct Secant {
  double force2 = 0, move2 = 0, both = 0;
  void add(double change_N, double moved_m) {
    force2 += change_N * change_N;
    move2 += moved_m * moved_m;
    both += change_N * moved_m;
  }
  double explained() const { return move2 > 0 && force2 > 0 ? both * both / (force2 * move2) : 0; }
};

// The motion of the contact's point of the mesh from `from_ns` on, within one transition.
Vec3 displacement(const SceneAt& scene, std::uint32_t number, const ComplianceEstimate& estimate,
                  std::int64_t from_ns) {
  const Instance& instance = scene.snapshot().instances[number];
  const PrimitiveId id{number, estimate.element};
  const MeshTransition* const way = instance.transitionAt(scene.time_ns());
  if (way == nullptr || way != instance.transitionAt(from_ns) || id.element >= way->to()->count()) return Vec3::Zero();
  const auto before = way->corners(id.element, way->part(from_ns));
  const auto now = way->corners(id.element, way->part(scene.time_ns()));
  const auto order = scene.primitive(id).order;
  Vec3 moved_O = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) moved_O += estimate.weights[i] * (now[order[i]] - before[order[i]]);
  return scene.turnToWorld(id, moved_O);
}

void append(double value, std::array<double, ComplianceEstimate::kFrames>& list) {
  std::rotate(list.begin(), list.begin() + 1, list.end());
  list.back() = value;
}

// A frame has come: the one before is complete.
void closeFrame(ComplianceEstimate& estimate, const ProxySettings& settings) {
  const auto ticks = static_cast<double>(estimate.ticks);
  append(estimate.moved_m, estimate.moves_m);
  append(estimate.sum_N / ticks, estimate.means_N);
  append(estimate.normal.dot(estimate.force_N), estimate.lasts_N);
  estimate.frame_s = ticks * settings.period_s;
  estimate.moved_m = estimate.sum_N = 0;
  estimate.ticks = 0;
  const double secant_m_N = estimate.secant_m_N(), servo_m_N = settings.world_per_device / settings.spring_N_m;
  if (secant_m_N < 0) return;
  const double told_m_N = secant_m_N > servo_m_N ? secant_m_N : 0;
  const double wanted = std::min(kRoundUp * told_m_N, kMaxEstimate_m_N), before = estimate.compliance_m_N;
  double change = wanted > before ? wanted - before : kDecay * (wanted - before);
  if (before + change < kLeast_m_N) change = -before;
  estimate.compliance_m_N = before + change;
  estimate.lift_m += change * estimate.force_N;  // the force stays what it is
}

}  // namespace

double ComplianceEstimate::secant_m_N() const {
  double best = 0, explained = kLeastExplained;
  bool told = false;
  for (const auto* forces_N : {&means_N, &lasts_N}) {
    for (std::size_t lag = 1; lag <= kMaxLag; ++lag) {
      Secant secant;
      for (std::size_t i = lag + 1; i < kFrames; ++i)
        secant.add((*forces_N)[i - lag] - (*forces_N)[i - lag - 1], moves_m[i]);
      if (secant.force2 < kLeastChange_N * kLeastChange_N) continue;
      told = true;
      if (secant.both >= 0 || secant.explained() <= explained) continue;
      explained = secant.explained();
      best = -secant.both / secant.force2;
    }
  }
  return told ? best : -1;
}

void followDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  ComplianceEstimate& estimate = state.estimate;
  if (estimate.key == 0) return;
  std::uint32_t number = 0;
  if (!scene.snapshot().find(estimate.key, number) || scene.snapshot().instances[number].compliance) {
    estimate = {};
    return;
  }
  const std::uint64_t geometry = scene.snapshot().instances[number].shape->geometry;
  if (estimate.geometry != geometry && estimate.ticks > 0) closeFrame(estimate, settings);
  estimate.geometry = geometry;
  if (state.snapshot == scene.snapshot().number) {
    const Vec3 moved = displacement(scene, number, estimate, state.time_ns);
    estimate.moved_m += estimate.normal.dot(moved);
    if (estimate.compliance_m_N > 0) estimate.lift_m -= moved;
  }
  estimate.sum_N += estimate.normal.dot(estimate.force_N);
  ++estimate.ticks;
  if (!(estimate.frame_s > 0)) return;
  const double part = std::min(1.0, settings.period_s / (kSettling * estimate.frame_s));
  estimate.lift_m += part * (estimate.compliance_m_N * estimate.force_N - estimate.lift_m);
  // F_k pushes.
  estimate.lift_m += std::max(0.0, -estimate.normal.dot(estimate.lift_m)) * estimate.normal;
  if (estimate.compliance_m_N == 0) estimate.lift_m = Vec3::Zero();
}

void rememberDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                         const TickReport& report, const Vec3& finger) {
  ComplianceEstimate& estimate = state.estimate;
  estimate.force_N = Vec3::Zero();
  const ContactParts parts = partsOf(report.contacts, state.position + state.rest_offset_m - finger);
  double most_m = 0;
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const ProxyContact& contact = report.contacts[i];
    const Instance& instance = scene.instance(contact.primitive);
    const bool deforms = instance.mesh_motion || instance.key == estimate.key;
    const Vec3 pull = state.stiffness * parts[i];
    if (!deforms || instance.compliance || !(pull.norm() > most_m)) continue;
    most_m = pull.norm();
    if (estimate.key != instance.key) {
      estimate = {};
      estimate.key = instance.key;
      estimate.geometry = instance.shape->geometry;
    }
    estimate.element = contact.primitive.element;
    estimate.weights = contact.weights;
    estimate.normal = contact.normal;
    estimate.force_N = settings.spring_N_m / settings.world_per_device * pull;
  }
}

}  // namespace hl
