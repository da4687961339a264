#include "touch/touch_session.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"

namespace hl {

namespace {

constexpr int kProxyPriority = 70;  // SCHED_FIFO
constexpr std::int64_t kSupervisorPeriod_ns = 16'666'667;
constexpr std::int64_t kPress_ns = 1'000'000'000;  // after which a button comes up by itself
constexpr double kApproach_s = 3.0;                // virtual time for the hand to reach the start
constexpr double kStartAbove_D = 0.020;            // m above the model at the hand
constexpr double kPress_D = 0.012;                 // m, how far beneath the surface the exploring hand aims
constexpr double kLift_D = 0.010;
// What a page may ask of a surface: beyond, a finger could not be moved.
constexpr double kMostFriction = 10;
constexpr double kMostViscosity_Ns_m = 1000;

VibrationView viewOf(const VibrationGuard& guard) { return {guard.limit_N_m, guard.alarms, guard.dissipated_J}; }

// For a session that nobody records.
class NoSink final : public StepSink {
  void start() override {}
  void stop() override {}
  void step(const ServoRecord&) noexcept override {}
  void tick(const TickRequest&, const ProxyStep&, const Vec3&, std::int64_t) noexcept override {}
  void scene(std::shared_ptr<const Snapshot>) noexcept override {}
  void stall() noexcept override {}
};

std::unique_ptr<StepSink> makeSink(const MakeStepSink& make, const SessionInfo& session) {
  if (make) return make(session);
  return std::make_unique<NoSink>();
}

std::int64_t period_ns(double rate_Hz) { return static_cast<std::int64_t>(1e9 / rate_Hz); }

}  // namespace

TouchSession::TouchSession(std::shared_ptr<const Snapshot> snapshot, const TouchSettings& settings,
                           std::unique_ptr<Device> device)
    : settings_(settings),
      device_(std::move(device)),
      servo_rate_Hz_(settings.servo_rate.of(device_->info())),
      hand_(device_->hand()),
      scenes_(std::move(snapshot)),
      proxy_loop_(scenes_, ProxySettings{}),
      place_(period_ns(servo_rate_Hz_)),
      sink_(makeSink(settings.sink, {device_->info(), servo_rate_Hz_, settings.proxy_rate_Hz, ProxySettings{}})),
      watch_(*device_, servo_counters_, [this] { sink_->stall(); }) {
  sink_->scene(scenes_.newest());
  const Vec3 reach_D = device_->info().workspace_max - device_->info().workspace_min;
  settings_.side_D = std::min(settings_.side_D, reach_D.minCoeff());
  fitted_ = settings.world_per_device || !scenes_.newest()->bounds.empty();
  Workspace workspace = Workspace::fit(scenes_.newest()->bounds, settings_.side_D);
  if (settings.world_per_device) workspace.world_per_device = *settings.world_per_device;
  proxy_commands_.workspace = workspace;
  proxy_commands_.radius_W = settings.radius_D * workspace.world_per_device;
  ledger_ = settings.ledger;
  setSurfaces(settings.surfaces);
  servo_settings_ = ServoSettings::of(device_->info());
  servo_settings_.period_s = 1 / servo_rate_Hz_;
  if (settings.damping_Ns_m) servo_settings_.damping_Ns_m = *settings.damping_Ns_m;
  settings.servo.apply(servo_settings_);
  setStiffness(settings.stiffness_N_m.value_or(device_->info().stiffness_N_m));
  setHandFirm(settings.hand_firm);
  exploring_ = hasHand() && (settings.explore || settings.script);
  if (hasHand()) bringHandToStart();
  startAt(device_->read(monotonicNow_ns()));
}

TouchSession::~TouchSession() {
  stop();
  device_->close();
}

// The hand moves freely, without force, on a virtual clock that ends now; the real clock then goes on from there.
void TouchSession::bringHandToStart() {
  const Workspace& workspace = proxy_commands_.workspace;
  const Box& bounds = scenes_.newest()->bounds;
  // Of the scene, or of the first world that will be fitted to the hand: it must not appear around the finger.
  const double top_D = 0.5 * (bounds.empty() ? settings_.side_D : bounds.size().y() / workspace.world_per_device);
  Vec3 goal_D = clampToWorkspace(Vec3(0, top_D + kStartAbove_D, 0));
  if (settings_.script) goal_D = clampToWorkspace(workspace.toDevice(settings_.script->at(0)));
  hand_->setHandGoal(goal_D);
  const std::int64_t now_ns = monotonicNow_ns();
  const std::int64_t step_ns = 1'000'000;
  for (std::int64_t t = now_ns - static_cast<std::int64_t>(kApproach_s * 1e9); t < now_ns; t += step_ns) {
    device_->read(t);
    device_->write(Vec3::Zero());
  }
}

void TouchSession::startAt(const DeviceSample& sample) {
  answered_ = sample.status == DeviceStatus::kOk;
  if (!answered_) return;
  finger_D_.write(sample.position);
  finger_for_supervisor_D_.write(sample.position);
}

Vec3 TouchSession::clampToWorkspace(const Vec3& goal_D) const {
  return goal_D.cwiseMax(device_->info().workspace_min).cwiseMin(device_->info().workspace_max);
}

void TouchSession::start() {
  start_ns_ = monotonicNow_ns();
  running_ = true;
  arm_requests_ = 1;
  sink_->start();
  proxy_thread_ = startThread("proxy", [this] { runProxy(); });
  servo_thread_ = startThread("servo", [this] { runServo(); });
  if (hasHand()) supervisor_thread_ = startThread("supervisor", [this] { runSupervisor(); });
  while (!servo_ready_) std::this_thread::yield();
  if (settings_.timer_reference) reference_thread_ = startThread("bare timer", [this] { runReference(); });
  watch_.start(ServoWatch::looks(grant_.fifo, servo_rate_Hz_));
}

void TouchSession::stop() {
  if (!running_.exchange(false)) return;
  watch_.stop();
  for (std::thread* thread : {&supervisor_thread_, &servo_thread_, &proxy_thread_, &reference_thread_}) {
    if (thread->joinable()) thread->join();
  }
  sink_->stop();
}

// What keeps a thread waiting differs from core to core: so it shares the servo's.
void TouchSession::runReference() {
  requestRealtime(kServoPriority, grant_.core);
  runPeriodic(period_ns(servo_rate_Hz_), running_, reference_counters_, [](std::int64_t) {});
}

void TouchSession::runServo() {
  int core = spareCore(0);
  if (core < 0 && settings_.timer_reference) core = sched_getcpu();
  grant_ = requestRealtime(kServoPriority, core);
  servo_ready_ = true;
  TouchStep step;
  ServoSettings settings = servo_settings_;
  LoopMeter meter;
  TickMessage last;
  std::uint64_t armed = 0;
  const auto make_step = [&] {
    const std::int64_t now_ns = monotonicNow_ns();
    settings.stiffness_N_m = stiffness_.load(std::memory_order_relaxed);
    settings.ledger = ledger_.load(std::memory_order_relaxed);
    const DeviceSample sample = readDevice(now_ns);
    ServoCommand command = ServoCommand::kNone;
    // A device that is not ready, homing or connecting, arms when it is.
    if (const std::uint64_t wanted = arm_requests_.load(std::memory_order_relaxed); watch_.takeStall()) {
      command = ServoCommand::kStall;
    } else if (wanted != armed && sample.status != DeviceStatus::kNotReady) {
      armed = wanted;
      command = ServoCommand::kArm;
    }
    const bool answers = sample.status == DeviceStatus::kOk;
    if (answers) finger_D_.write(sample.position);
    if (answers && !answered_) arrivals_.fetch_add(1, std::memory_order_release);
    answered_ = answers;
    const ServoState before = step.servo();
    apply(step.servo(), command);
    const ServoOutput out = touchNow(step, settings, sample, last);
    makes_force_.store(makesForce(step.servo()), std::memory_order_relaxed);
    if (watch_.stalled()) device_->write(Vec3::Zero());  // found while this step stood still: its force is an old one
    finger_for_supervisor_D_.write(sample.position);
    samples_.push({1e-9 * static_cast<double>(now_ns - start_ns_), static_cast<float>(out.force_N.norm()),
                   step.target().valid ? static_cast<float>((step.target().proxy_D - sample.position).norm()) : 0.0f,
                   last.work_us});
    moments_.push({now_ns, sample.position, out.force_N, sample.buttons});
    const std::int64_t work_ns = monotonicNow_ns() - now_ns;
    sink_->step({before, command, settings, step.target(), sample, out, work_ns});
    meter.add(now_ns, work_ns);
    const ServoView view{sample.buttons,
                         sample.position,
                         out.force_N,
                         out.safety,
                         out.fault,
                         step.servo().spring.ledger,
                         viewOf(step.servo().vibration),
                         meter.summary()};
    servo_view_.write(view);
    servo_for_clients_.write(view);
  };
  const auto end_force = [this] { device_->write(Vec3::Zero()); };
  runPeriodic(period_ns(servo_rate_Hz_), running_, servo_counters_, [&](std::int64_t) {
    if (guarded(make_step)) return;
    step_failed_ = true;
    guarded(end_force);
  });
  guarded(end_force);
}

// A driver that throws has lost its device. After a step that threw elsewhere there is no sample either, so that none
// is ticked with and the servo goes its way to zero force.
DeviceSample TouchSession::readDevice(std::int64_t now_ns) noexcept {
  DeviceSample sample;
  const bool read = guarded([&] { sample = device_->read(now_ns); });
  if (!read) sample = DeviceSample{};
  if (!read) sample.time_ns = now_ns;
  if (std::exchange(step_failed_, false) || !read) sample.status = DeviceStatus::kLost;
  return sample;
}

// From the sample to the motors: with a tick on the way when it is the servo's turn to tick.
ServoOutput TouchSession::touchNow(TouchStep& step, const ServoSettings& settings, const DeviceSample& sample,
                                   TickMessage& last) {
  if (!place_.onServo()) {
    TickMessage newest;
    if (ticks_.read(newest) && newest.held.target.time_ns > last.held.target.time_ns) last = newest;
    const ServoOutput out = step.late(last.held, settings, sample);
    device_->write(out.force_N);
    return out;
  }
  const std::int64_t begin_ns = monotonicNow_ns();
  const SpringOfServo spring = springOf(settings, step.servo());
  const ServoOutput out = step.onTime(proxy_loop_, ticking_.follow(*this), settings, sample);
  device_->write(out.force_N);
  const std::int64_t work_ns = monotonicNow_ns() - begin_ns;
  last = {step.tick().held, 1e-3f * static_cast<float>(work_ns)};
  sink_->tick({sample.time_ns, sample.position, ticking_.commands, spring}, step.tick(), proxy_loop_.state().position,
              work_ns);
  show(step.tick(), begin_ns, work_ns);
  return out;
}

void TouchSession::runProxy() {
  requestRealtime(kProxyPriority, spareCore(1));
  Vec3 finger_D = Vec3::Zero();
  const auto tick = [&] {
    const std::int64_t now_ns = monotonicNow_ns();
    const ProxyCommands& commands = ticking_.follow(*this);
    finger_D_.read(finger_D);
    const SpringOfServo spring{stiffness_.load(std::memory_order_relaxed), ledger_.load(std::memory_order_relaxed),
                               1 / settings_.proxy_rate_Hz, makes_force_.load(std::memory_order_relaxed)};
    const ProxyStep step = proxy_loop_.step(now_ns, finger_D, commands, spring);
    const std::int64_t work_ns = monotonicNow_ns() - now_ns;
    ticks_.write({step.held, 1e-3f * static_cast<float>(work_ns)});
    sink_->tick({now_ns, finger_D, commands, spring}, step, proxy_loop_.state().position, work_ns);
    show(step, now_ns, work_ns);
  };
  runPeriodic(period_ns(settings_.proxy_rate_Hz), running_, proxy_counters_, [&](std::int64_t) {
    if (!place_.onServo()) guarded(tick);
  });
}

const ProxyCommands& TouchSession::Ticking::follow(TouchSession& session) {
  const std::uint64_t arrivals = session.arrivals_.load(std::memory_order_acquire);
  session.commands_for_proxy_.read(commands);
  commands.restarts += arrivals;
  return commands;
}

// By the loop that has ticked, at last: the next tick may be the other's.
void TouchSession::show(const ProxyStep& step, std::int64_t now_ns, std::int64_t work_ns) {
  ticking_.meter.add(now_ns, work_ns);
  const ProxyState& state = proxy_loop_.state();
  ProxyView& view = ticking_.view;
  view.proxy = state.position;
  view.contacts = step.report.contacts;
  view.touched = step.touched;
  view.slipping = state.touching && state.rest_s == 0;
  view.ledger = state.ledger;
  view.ended.add(step.report.ending);
  view.loop = ticking_.meter.summary();
  proxy_view_.write(view);
  proxy_for_clients_.write(view);
  tick_count_.fetch_add(1, std::memory_order_relaxed);
  if (place_.onServo()) ticks_in_servo_steps_.fetch_add(1, std::memory_order_relaxed);
  last_tick_ns_.store(now_ns, std::memory_order_release);
  place_.took(work_ns);
}

// Where the script or the exploration wants the hand; with nothing to stroke it waits.
std::optional<Vec3> TouchSession::strokingGoal() const {
  if (settings_.script) return settings_.script->at(time_s());
  const std::shared_ptr<const Snapshot> scene = snapshot();
  if (scene->bounds.empty()) return {};
  const double scale = workspace().world_per_device;
  return explore({*scene, monotonicNow_ns()}, {kPress_D * scale, kLift_D * scale, radius_W()}, time_s());
}

TouchSession::Commands TouchSession::takeCommands() {
  const std::lock_guard lock(commands_mutex_);
  return std::exchange(commands_, {});
}

// Decides where the hand wants to be: a person, the script or the exploration, in this order.
void TouchSession::moveHand(const Commands& commands) {
  if (commands.explore) exploring_ = *commands.explore;
  const Workspace workspace = this->workspace();
  if (commands.goal_W) {
    exploring_ = false;
    hand_->setHandGoal(clampToWorkspace(workspace.toDevice(*commands.goal_W)));
  } else if (commands.release) {
    Vec3 finger_D = Vec3::Zero();
    finger_for_supervisor_D_.read(finger_D);
    hand_->setHandGoal(clampToWorkspace(finger_D));
  } else if (exploring_) {
    if (const auto goal_W = strokingGoal()) hand_->setHandGoal(clampToWorkspace(workspace.toDevice(*goal_W)));
  }
  hand_->setHandFirm(hand_firm_);
}

void TouchSession::runSupervisor() {
  LoopCounters counters;
  std::int64_t pressed_ns = 0;
  const auto supervise = [&](std::int64_t now_ns) {
    const Commands commands = takeCommands();
    moveHand(commands);
    if (commands.buttons) {
      hand_->setHandButtons(*commands.buttons);
      pressed_ns = now_ns;
    } else if (now_ns - pressed_ns > kPress_ns) {
      hand_->setHandButtons(0);
    }
  };
  runPeriodic(kSupervisorPeriod_ns, running_, counters,
              [&](std::int64_t now_ns) { guarded([&] { supervise(now_ns); }); });
}

void TouchSession::setHandGoal(const Vec3& goal_W) {
  if (!hasHand() || !goal_W.allFinite()) return;
  const std::lock_guard lock(commands_mutex_);
  commands_.goal_W = goal_W;
  commands_.release = false;
}

void TouchSession::release() {
  if (!hasHand()) return;
  const std::lock_guard lock(commands_mutex_);
  commands_.release = true;
  commands_.goal_W.reset();
}

void TouchSession::press(std::uint32_t buttons) {
  if (!hasHand()) return;
  const std::lock_guard lock(commands_mutex_);
  commands_.buttons = buttons;
}

void TouchSession::setExplore(bool on) {
  if (!hasHand()) return;
  const std::lock_guard lock(commands_mutex_);
  commands_.explore = on;
}

void TouchSession::setHandFirm(bool firm) { hand_firm_ = firm; }

void TouchSession::setStiffness(double stiffness_N_m) {
  if (!(stiffness_N_m >= 0)) return;
  stiffness_ = std::min(stiffness_N_m, device_->info().stiffness_max_N_m);
}

void TouchSession::setSurfaces(const MaterialOverride& surfaces) {
  const auto within = [](std::optional<double>& value, double most) {
    if (value && !(*value >= 0)) value.reset();
    if (value) value = std::min(*value, most);
  };
  const std::lock_guard lock(settings_mutex_);
  MaterialOverride& own = proxy_commands_.surfaces;
  own = surfaces;
  within(own.stiffness, 1);
  within(own.static_friction, kMostFriction);
  within(own.dynamic_friction, kMostFriction);
  within(own.viscosity_Ns_m, kMostViscosity_Ns_m);
  commands_for_proxy_.write(proxy_commands_);
}

void TouchSession::setLedger(LedgerMode mode) { ledger_ = mode; }

MaterialOverride TouchSession::surfaces() const {
  const std::lock_guard lock(settings_mutex_);
  return proxy_commands_.surfaces;
}

Workspace TouchSession::workspace() const {
  const std::lock_guard lock(settings_mutex_);
  return proxy_commands_.workspace;
}

double TouchSession::radius_W() const {
  const std::lock_guard lock(settings_mutex_);
  return proxy_commands_.radius_W;
}

std::shared_ptr<const Snapshot> TouchSession::snapshot() const {
  const std::lock_guard lock(settings_mutex_);
  return scenes_.newest();
}

void TouchSession::restartWith(const Workspace& workspace, double radius_W) {
  proxy_commands_.workspace = workspace;
  proxy_commands_.radius_W = radius_W;
  ++proxy_commands_.restarts;
  commands_for_proxy_.write(proxy_commands_);
}

void TouchSession::setWorkspace(const Workspace& workspace) {
  if (!workspace.valid()) return;
  const std::lock_guard lock(settings_mutex_);
  fitted_ = true;
  const double radius_D = proxy_commands_.radius_W / proxy_commands_.workspace.world_per_device;
  restartWith(workspace, radius_D * workspace.world_per_device);
}

void TouchSession::setRadius(double radius_W) {
  if (!Workspace::validRadius(radius_W)) return;
  const std::lock_guard lock(settings_mutex_);
  restartWith(proxy_commands_.workspace, radius_W);
}

void TouchSession::publish(std::shared_ptr<const Snapshot> snapshot) {
  const std::lock_guard lock(settings_mutex_);
  if (!fitted_ && !snapshot->bounds.empty()) {
    fitted_ = true;
    const Workspace workspace = Workspace::fit(snapshot->bounds, settings_.side_D);
    restartWith(workspace, settings_.radius_D * workspace.world_per_device);
  }
  sink_->scene(snapshot);
  scenes_.publish(std::move(snapshot));
}

void TouchSession::dropSceneBefore() {
  const std::lock_guard lock(settings_mutex_);
  scenes_.dropBefore();
}

bool TouchSession::ready(std::int64_t since_ns) const {
  if (!running_ || watch_.stalled()) return true;
  return scenes_.taken() && last_tick_ns_.load(std::memory_order_acquire) >= since_ns;
}

void TouchSession::rearm() { arm_requests_.fetch_add(1); }

void TouchSession::viewsForClients(ServoView& servo, ProxyView& proxy) {
  servo_for_clients_.read(servo);
  proxy_for_clients_.read(proxy);
  tellStall(servo);
}

void TouchSession::views(ServoView& servo, ProxyView& proxy) {
  servo_view_.read(servo);
  proxy_view_.read(proxy);
  tellStall(servo);
}

// What stands still can not tell so itself.
void TouchSession::tellStall(ServoView& servo) const {
  if (!watch_.stalled()) return;
  servo.force_N = Vec3::Zero();
  servo.safety = SafetyState::kFault;
  servo.fault = FaultReason::kStalled;
}

LoopTotals TouchSession::proxyTotals() const {
  LoopTotals totals = TouchSession::totals(proxy_counters_);
  totals.steps = tick_count_.load();
  return totals;
}

LoopTotals TouchSession::totals(const LoopCounters& counters) {
  LoopTotals totals{counters.steps.load(), counters.deadlines_missed.load(), counters.late_max_ns.load()};
  std::copy(counters.duty.begin(), counters.duty.end(), totals.duty.begin());
  totals.page_faults = counters.page_faults.load();
  totals.waits = counters.waits.load();
  totals.preempted = counters.preempted.load();
  return totals;
}

}  // namespace hl
