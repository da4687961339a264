// ServoRecord: all that goes into one step of the servo and comes out of it, so that the step can be made again.
#pragma once

#include <cstdint>

#include "control/servo.h"

namespace hl {

/// What is done to the servo between two steps.
enum class ServoCommand : std::uint8_t { kNone, kArm, kDisarm, kStall };

/// RT-safe.
inline void apply(ServoState& state, ServoCommand command) {
  if (command == ServoCommand::kArm) arm(state);
  if (command == ServoCommand::kDisarm) disarm(state);
  if (command == ServoCommand::kStall) fail(state, FaultReason::kStalled);
}

struct ServoRecord {
  ServoState before;  ///< of the command
  ServoCommand command = ServoCommand::kNone;
  ServoSettings settings;
  ServoTarget target;
  DeviceSample sample;
  ServoOutput out;
  std::int64_t work_ns = 0;  ///< from the time of the sample to the end of the step
};

template <typename Visit>
void visitFields(Ledger& ledger, Visit& visit) {
  visit(ledger.tank_J);
  visit(ledger.injected_J);
  visit(ledger.dissipated_J);
  for (double& joules : ledger.by_cause_J) visit(joules);
}

template <typename Visit>
void visitFields(ServoState& state, Visit& visit) {
  visit(state.safety);
  visit(state.fault);
  visit(state.ramp);
  visit(state.missed);
  visit(state.well_steps);
  visit(state.watching);
  visit(state.watched_ns);
  visit(state.mark_D);
  visit(state.mark_ns);
  visit(state.speed_m_s);
  visit(state.force_N);
  visit(state.velocity_m_s);
  visit(state.last_position);
  for (Vec3& before_D : state.before_D) visit(before_D);
  visit(state.last_time_ns);
  visit(state.has_last);
  visit(state.spring.end.proxy_D);
  visit(state.spring.end.stiffness);
  visit(state.spring.pulling);
  visitFields(state.spring.ledger, visit);
  visit(state.spring_time_ns);
  visit(state.guard.energy_J);
  visit(state.guard.held_N);
  visit(state.guard.dissipated_J);
}

template <typename Visit>
void visitFields(ServoSettings& settings, Visit& visit) {
  visit(settings.period_s);
  visit(settings.velocity_limit_m_s);
  visit(settings.ramp_s);
  visit(settings.target_stale_ns);
  visit(settings.target_lost_ns);
  visit(settings.missed_limit);
  visit(settings.dead_man);
  visit(settings.dead_man_button);
  visit(settings.arm_again);
  visit(settings.stiffness_N_m);
  visit(settings.damping_Ns_m);
  visit(settings.force_limit_N);
  visit(settings.force_rate_limit_N_s);
  visit(settings.friction_N);
  visit(settings.ledger);
  visit(settings.effects.tool_mass_kg);
  visit(settings.effects.free_damping_Ns_m);
  visit(settings.effects.spring_N_m);
  visit(settings.effects.spring_D);
  visit(settings.effects.constant_N);
  visit(settings.guard.on);
  visit(settings.guard.damping_limit_Ns_m);
}

template <typename Visit>
void visitFields(DeviceInfo& info, Visit& visit) {
  visit(info.workspace_min);
  visit(info.workspace_max);
  visit(info.force_max_N);
  visit(info.force_continuous_N);
  visit(info.force_rate_max_N_s);
  visit(info.stiffness_N_m);
  visit(info.stiffness_max_N_m);
  visit(info.damping_Ns_m);
  visit(info.friction_N);
  visit(info.resolution_m);
  visit(info.velocity_max_m_s);
  visit(info.servo_rate_Hz);
}

}  // namespace hl
