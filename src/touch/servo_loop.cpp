#include "touch/servo_loop.h"

#include <sched.h>

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"

namespace hl {

namespace {

// A servo that is late cannot hurt a simulated hand: on a busy machine it goes on as well as it can.
ServoSettings servoSettingsOf(const TouchSettings& settings, Device& device, double rate_Hz) {
  ServoSettings servo = ServoSettings::of(device.info());
  servo.period_s = 1 / rate_Hz;
  if (device.hand() != nullptr) servo.missed_limit = SafetySettings::kNoLimit;
  if (settings.damping_Ns_m) servo.damping_Ns_m = *settings.damping_Ns_m;
  settings.servo.apply(servo);
  return servo;
}

// What later steps go on with; after a step without a tick nothing holds the proxy.
HeldContacts heldAfter(const TouchStep& step) {
  if (step.tick()) return step.tick()->held;
  HeldContacts held;
  held.target = step.target();
  return held;
}

VibrationView viewOf(const VibrationGuard& guard) { return {guard.limit_N_m, guard.alarms, guard.dissipated_J}; }

}  // namespace

ServoLoop::ServoLoop(const LoopParts& parts, const TouchSettings& settings, double rate_Hz)
    : parts_(parts),
      reader_(parts.device, parts.exchange),
      settings_(servoSettingsOf(settings, parts.device, rate_Hz)),
      effects_(settings_.effects),
      share_core_(settings.timer_reference),
      watch_(parts.device, counters_, [this] {
        parts_.exchange.makes_force.store(false, std::memory_order_relaxed);
        parts_.faults.set(true);
        parts_.sink.stall();
      }) {}

void ServoLoop::look() {
  const DeviceSample sample = reader_.look(monotonicNow_ns());
  if (sample.status == DeviceStatus::kOk) parts_.exchange.hand.write({sample.position, sample.position});
}

void ServoLoop::start(std::int64_t begin_ns) {
  begin_ns_ = begin_ns;
  thread_.start("servo", [this] { run(); });
  while (!ready_) std::this_thread::yield();
  watch_.start(ServoWatch::looks(grant_.fifo, 1 / settings_.period_s));
}

void ServoLoop::stop() {
  watch_.stop();
  thread_.stop();
}

void ServoLoop::run() {
  int core = spareCore(0);
  if (core < 0 && share_core_) core = sched_getcpu();
  grant_ = requestRealtime(kServoPriority, core);
  ready_ = true;
  const auto end_force = [this] { parts_.device.write(Vec3::Zero()); };
  runPeriodic(periodOf_ns(1 / settings_.period_s), thread_.running(), counters_, [&](std::int64_t) {
    if (guarded([this] { step(); })) return;
    reader_.stepFailed();
    guarded(end_force);
  });
  guarded(end_force);
}

void ServoLoop::step() {
  const std::int64_t now_ns = monotonicNow_ns();
  settings_.stiffness_N_m = parts_.live.stiffness_N_m();
  settings_.ledger = parts_.live.ledger();
  HandPull pull;
  parts_.exchange.pulls.read(pull);
  settings_.effects = withPull(effects_, pull, now_ns);
  parts_.exchange.remotes.read(settings_.remote);
  const DeviceSample sample = reader_.read(now_ns);
  const ServoCommand command = commandFor(sample);
  const ServoState before = step_.servo();
  apply(step_.servo(), command);
  const ServoOutput out = touch(sample);
  shareFault();
  parts_.exchange.makes_force.store(makesForce(step_.servo()), std::memory_order_relaxed);
  // Found while this step stood still: its force is an old one.
  if (watch_.stalled()) parts_.device.write(Vec3::Zero());
  const ServoTarget& target = step_.target();
  parts_.exchange.hand.write({sample.position, target.valid ? target.proxy_D : sample.position});
  if (settings_.remote.on) parts_.exchange.remote_ports.write(step_.servo().remote);
  publish({before, command, settings_, step_.target(), sample, out, 0}, now_ns);
}

// A device that is not ready, homing or connecting, arms when it is; one that stops with others, when none is in fault.
ServoCommand ServoLoop::commandFor(const DeviceSample& sample) {
  const std::uint64_t wanted = parts_.live.armRequests();
  if (watch_.takeStall()) return ServoCommand::kStall;
  if (parts_.faults.othersFail()) return isArmed(step_.servo()) ? ServoCommand::kJoin : ServoCommand::kNone;
  if (armsAgain()) return ServoCommand::kArm;
  if (wanted == armed_ || sample.status == DeviceStatus::kNotReady) return ServoCommand::kNone;
  armed_ = wanted;
  return ServoCommand::kArm;
}

// One that has stopped for another, with nobody in fault any more.
bool ServoLoop::armsAgain() {
  const ServoState& state = step_.servo();
  return settings_.arm_again && state.safety == SafetyState::kFault && state.fault == FaultReason::kOtherDevice;
}

void ServoLoop::shareFault() {
  const ServoState& state = step_.servo();
  parts_.faults.set(state.safety == SafetyState::kFault && state.fault != FaultReason::kOtherDevice);
}

// From the sample to the motors.
ServoOutput ServoLoop::touch(const DeviceSample& sample) {
  if (parts_.ticker.isTurnOf(Turn::kServo)) return tickAndTouch(sample);
  TickMessage newest;
  if (parts_.exchange.ticks.read(newest) && newest.held.target.time_ns > last_tick_.held.target.time_ns)
    last_tick_ = newest;
  const ServoOutput out = step_.late(last_tick_.held, settings_, sample);
  parts_.device.write(out.force_N);
  return out;
}

ServoOutput ServoLoop::tickAndTouch(const DeviceSample& sample) {
  const std::int64_t begin_ns = monotonicNow_ns();
  const SpringOfServo spring = springOf(settings_, step_.servo());
  const ProxyCommands& commands = parts_.ticker.follow();
  const ServoOutput out = step_.onTime(parts_.ticker.loop(), commands, settings_, sample);
  parts_.device.write(out.force_N);
  const std::int64_t work_ns = monotonicNow_ns() - begin_ns;
  last_tick_ = {heldAfter(step_), 1e-3f * static_cast<float>(work_ns)};
  const ProxyStep* const tick = step_.tick() ? &*step_.tick() : nullptr;
  parts_.ticker.done({sample.time_ns, sample.position, commands, spring}, tick, begin_ns, work_ns);
  return out;
}

void ServoLoop::publish(const ServoRecord& record, std::int64_t begin_ns) {
  const DeviceSample& sample = record.sample;
  const ServoOutput& out = record.out;
  const ServoTarget& target = record.target;
  const double penetration_m = target.valid ? (target.proxy_D - sample.position).norm() : 0;
  parts_.views.samples.push({seconds(begin_ns - begin_ns_), static_cast<float>(out.force_N.norm()),
                             static_cast<float>(penetration_m), last_tick_.work_us});
  parts_.views.moments.push({begin_ns, sample.position, out.force_N, sample.buttons, sample.status == DeviceStatus::kOk,
                             sample.stylus, sharing(last_tick_.held.contacts, last_tick_.held.held_N, out.force_N)});
  ServoRecord timed = record;
  timed.work_ns = monotonicNow_ns() - begin_ns;
  parts_.sink.step(timed);
  meter_.add(begin_ns, timed.work_ns);
  parts_.views.servo.write({sample.buttons, sample.position, out.force_N, sample.stylus, out.safety, out.fault,
                            step_.servo().spring.ledger, viewOf(step_.servo().vibration), meter_.summary()});
}

void ServoLoop::markStall(ServoView& view) const {
  if (!watch_.stalled()) return;
  view.force_N = Vec3::Zero();
  view.safety = SafetyState::kFault;
  view.fault = FaultReason::kStalled;
}

}  // namespace hl
