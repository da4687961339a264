#include "session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "put.h"

namespace hl {

namespace {

constexpr double kSide_D = 0.12, kRadius_D = 0.002;  // m at the hand, as hl touch without options
constexpr double kApproach_s = 3, kStartAbove_D = 0.020;
constexpr int kStepsOfHand = 16;  // the hand's goal is moved about 60 times a second

}  // namespace

WebSession::WebSession(std::shared_ptr<const Snapshot> snapshot)
    : snapshot_(std::move(snapshot)),
      sent_(snapshot_),
      scenes_(snapshot_),
      loop_(scenes_, ProxySettings{}),
      settings_(ServoSettings::of(device_.info())),
      period_ns_(static_cast<std::int64_t>(1e9 / device_.info().servo_rate_Hz)) {
  settings_.period_s = 1 / device_.info().servo_rate_Hz;
  commands_.workspace = Workspace::fit(snapshot_->bounds, std::min(kSide_D, device_.info().smallestReach_D()));
  commands_.radius_W = kRadius_D * commands_.workspace.world_per_device;
  describeScene();
  bringToStart();
  rearm();
}

void WebSession::bringToStart() {
  const double top_D = 0.5 * snapshot_->bounds.size().y() / commands_.workspace.world_per_device;
  device_.setHandGoal(clamped(Vec3(0, top_D + kStartAbove_D, 0)));
  const auto end_ns = static_cast<std::int64_t>(1e9 * kApproach_s);
  for (; now_ns_ < end_ns; now_ns_ += 1'000'000) {
    sample_ = device_.read(now_ns_);
    device_.write(Vec3::Zero());
  }
  begin_ns_ = now_ns_;
}

void WebSession::step(int steps) {
  for (int i = 0; i < steps; ++i) oneStep();
}

void WebSession::oneStep() {
  if (exploring_ && steps_ % kStepsOfHand == 0) moveHand();
  now_ns_ += period_ns_;
  sample_ = device_.read(now_ns_);
  out_ = step_.onTime(loop_, commands_, settings_, sample_);
  device_.write(out_.force_N);
  if (step_.tick()) endings_.add(step_.tick()->report.ending);
  ++steps_;
}

void WebSession::moveHand() {
  const Workspace& workspace = commands_.workspace;
  const ServoTarget& target = step_.target();
  const DeviceInfo& info = device_.info();
  const ExploringHand hand{workspace.toWorld(target.valid ? target.proxy_D : sample_.position),
                           commands_.radius_W,
                           workspace.world_per_device,
                           pressOf(firm_, settings_.stiffness_N_m, workspace.world_per_device),
                           {workspace.toWorld(info.workspace_min), workspace.toWorld(info.workspace_max)}};
  const Vec3 goal_W = exploration_.goal({*snapshot_, now_ns_}, hand, 1e-9 * static_cast<double>(now_ns_ - begin_ns_));
  device_.setHandGoal(clamped(workspace.toDevice(goal_W)));
}

void WebSession::setExplore(bool on) {
  exploring_ = on;
  exploration_.begin();
}

Vec3 WebSession::clamped(const Vec3& goal_D) const {
  return goal_D.cwiseMax(device_.info().workspace_min).cwiseMin(device_.info().workspace_max);
}

void WebSession::setGoal(const Vec3& goal_W) {
  if (!goal_W.allFinite()) return;
  exploring_ = false;
  device_.setHandGoal(clamped(commands_.workspace.toDevice(goal_W)));
}

void WebSession::release() { device_.setHandGoal(clamped(sample_.position)); }

void WebSession::setFirm(bool firm) {
  firm_ = firm;
  device_.setHandFirm(firm);
}

void WebSession::setStiffness(double stiffness_N_m) {
  if (stiffness_N_m > 0) settings_.stiffness_N_m = std::min(stiffness_N_m, device_.info().stiffness_max_N_m);
}

void WebSession::setIso(int volume, const IsoChoice& choice) {
  if (!std::isfinite(*choice.value)) throw Error("the value of a surface must be a number");
  const auto object = static_cast<std::size_t>(sent_.volume(volume).object);
  std::vector<Instance> instances = snapshot_->instances;
  const std::uint64_t number = snapshot_->number + 1;
  hl::setIso(instances[object], choice);
  instances[object].replaced_in = number;
  snapshot_ = makeSnapshot(std::move(instances), snapshot_->name, number, 0, snapshot_->mechanics);
  sent_.replace(snapshot_, object);
  scenes_.publish(snapshot_);
  scenes_.dropBefore();
}

void WebSession::describeScene() {
  const DeviceInfo& info = device_.info();
  scene_.force_max_N = info.force_max_N;
  scene_.stiffness_N_m = settings_.stiffness_N_m;
  scene_.stiffness_max_N_m = info.stiffness_max_N_m;
  scene_.damping_Ns_m = settings_.damping_Ns_m;
  scene_.rate_Hz = info.servo_rate_Hz;
  put(scene_.bounds_min, snapshot_->bounds.min);
  put(scene_.bounds_max, snapshot_->bounds.max);
  scene_.radius = commands_.radius_W;
  scene_.world_per_device = commands_.workspace.world_per_device;
  put(scene_.gravity, snapshot_->mechanics.gravity_m_s2);
  scene_.objects = static_cast<double>(sent_.objects());
  scene_.joints = static_cast<double>(sent_.joints());
  scene_.snaps = static_cast<double>(snapshot_->snaps.size());
  scene_.fields = static_cast<double>(snapshot_->fields.size());
  scene_.volumes = static_cast<double>(sent_.volumes());
}

const HlWebState& WebSession::state() {
  state_.time_s = 1e-9 * static_cast<double>(now_ns_ - begin_ns_);
  put(state_.finger, commands_.workspace.toWorld(sample_.position));
  put(state_.proxy, loop_.state().position);
  put(state_.force_N, out_.force_N);
  state_.safety = static_cast<double>(out_.safety);
  state_.fault = static_cast<double>(out_.fault);
  const ServoTarget& target = step_.target();
  state_.penetration_m = target.valid ? (target.proxy_D - sample_.position).norm() : 0;
  state_.slipping = loop_.state().touching && loop_.state().sticking.since_slip_s == 0;
  state_.exploring = exploring_;
  state_.firm = firm_;
  state_.buttons = sample_.buttons;
  for (Eigen::Index i = 0; i < 4; ++i) state_.stylus[i] = sample_.stylus.turned.coeffs()[i];
  state_.stiffness_N_m = settings_.stiffness_N_m;
  state_.steps = static_cast<double>(steps_);
  describeTouch();
  describeEnergy();
  describeBodies();
  return state_;
}

void WebSession::describeTouch() {
  state_.contacts = 0;
  state_.snap = -1;
  if (!step_.tick()) return;
  const ProxyStep& tick = *step_.tick();
  std::uint32_t object = 0;
  state_.contacts = static_cast<double>(tick.report.contacts.size());
  for (std::size_t i = 0; i < tick.report.contacts.size(); ++i) {
    const ProxyContact& contact = tick.report.contacts[i];
    HlWebContact& out = state_.contact[i];
    put(out.point, contact.point);
    put(out.normal, contact.normal);
    out.multiplier_m = contact.multiplier_m;
    out.static_friction = contact.static_friction;
    out.stiffness = contact.stiffness;
    state_.touched[i] = snapshot_->find(tick.touched[i].key, object) ? object : -1.0;
  }
  if (!snapshot_->find(tick.snap.object.key, object)) return;
  for (std::size_t i = 0; i < snapshot_->snaps.size(); ++i) {
    const PlacedSnap& snap = snapshot_->snaps[i];
    if (snap.instance == object && snap.number == tick.snap.number) state_.snap = static_cast<double>(i);
  }
}

void WebSession::describeBodies() {
  if (loop_.bodies() == nullptr) return;
  const BodyView& view = loop_.bodies()->view();
  const EnergyBook& book = view.energy;
  state_.bodies = {static_cast<double>(view.bodies),
                   static_cast<double>(view.awake),
                   view.kinetic_J,
                   view.gravity_J,
                   view.spring_J,
                   book.by_hand_J,
                   book.contact_J,
                   book.friction_J,
                   book.joint_J(),
                   book.solver_J,
                   view.lost_s,
                   static_cast<double>(view.returned)};
}

void WebSession::describeEnergy() {
  const Ledger& ledger = loop_.state().ledger;
  const Ledger& late = step_.servo().spring.ledger;
  state_.tank_J = ledger.tank_J;
  state_.injected_J = ledger.injected_J + late.injected_J;
  state_.dissipated_J = ledger.dissipated_J + late.dissipated_J;
  for (std::size_t i = 0; i < kEnergyCauses; ++i) state_.by_cause_J[i] = ledger.by_cause_J[i];
  state_.by_cause_J[kEnergyCauses - 1] = late.by_cause_J[kEnergyCauses - 1];
  const VibrationGuard& guard = step_.servo().vibration;
  state_.vibration_limit_N_m = guard.limit_N_m;
  state_.vibration_alarms = static_cast<double>(guard.alarms);
  state_.vibration_dissipated_J = guard.dissipated_J;
  std::size_t i = 0;
  endings_.each([&](Ending, std::uint64_t count) { state_.endings[i++] = static_cast<double>(count); });
}

}  // namespace hl
