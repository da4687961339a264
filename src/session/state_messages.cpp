#include "session/state_messages.h"
#include "session/stylus_messages.h"

namespace hl {

void toProto(const TouchSession& session, proto::DeviceInfo& out) {
  const DeviceInfo& info = session.deviceInfo();
  out.set_name(info.name);
  out.set_label(session.label().name);
  out.set_force_max_n(info.force_max_N);
  out.set_stiffness_n_m(session.live().stiffness_N_m());
  out.set_stiffness_max_n_m(info.stiffness_max_N_m);
  out.set_force_rate_max_n_s(info.force_rate_max_N_s);
  out.set_simulated_hand(session.hasHand());
  out.set_has_wrist(info.has_wrist);
  out.set_gripper_max_rad(info.gripper_max_rad);
  out.set_damping_ns_m(session.settings().damping_Ns_m.value_or(info.damping_Ns_m));
  out.set_servo_rate_hz(session.servoRate_Hz());
  out.set_proxy_rate_hz(session.settings().proxy_rate_Hz);
}

void toProto(const LoopSummary& loop, const LoopTotals& totals, proto::LoopStats& out) {
  out.set_rate_hz(loop.rate_Hz);
  out.set_time_p50_us(1e-3 * static_cast<double>(loop.p50_ns));
  out.set_time_p999_us(1e-3 * static_cast<double>(loop.p999_ns));
  out.set_time_max_us(1e-3 * static_cast<double>(loop.max_ns));
  out.set_deadlines_missed(totals.missed);
  out.set_steps(totals.steps);
}

void toProto(const VibrationView& vibration, proto::Vibration& out) {
  out.set_limit_n_m(vibration.limit_N_m);
  out.set_alarms(vibration.alarms);
  out.set_dissipated_j(vibration.dissipated_J);
}

void toProto(const EndingCounts& ended, proto::TicksEnded& out) {
  out.set_reached(ended[Ending::kReached]);
  out.set_stationary(ended[Ending::kStationary]);
  out.set_settled(ended[Ending::kSettled]);
  out.set_stalled(ended[Ending::kStalled]);
  out.set_postponed(ended[Ending::kPostponed]);
  out.set_no_energy(ended[Ending::kNoEnergy]);
  out.set_crowded(ended[Ending::kCrowded]);
  out.set_capped(ended[Ending::kCapped]);
  out.set_out_of_work(ended[Ending::kOutOfWork]);
  out.set_unplaced(ended[Ending::kUnplaced]);
  out.set_invalid(ended[Ending::kInvalid]);
}

void toProto(const ProxyContact& contact, proto::ContactPlane& out) {
  toProto(contact.point, *out.mutable_point());
  toProto(contact.normal, *out.mutable_normal());
  out.set_multiplier_m(contact.multiplier_m);
  out.set_static_friction(contact.static_friction);
  out.set_stiffness(contact.stiffness);
}

void toProto(const Ledger& ledger, const Ledger& late, LedgerMode mode, proto::Ledger& out) {
  const auto cause = [&](EnergyCause c) { return ledger.by_cause_J[static_cast<std::size_t>(c)]; };
  out.set_mode(static_cast<proto::LedgerMode>(mode));
  out.set_tank_j(ledger.tank_J);
  out.set_injected_j(ledger.injected_J + late.injected_J);
  out.set_dissipated_j(ledger.dissipated_J + late.dissipated_J);
  out.set_shading_j(cause(EnergyCause::kShading));
  out.set_stiffness_j(cause(EnergyCause::kStiffness));
  out.set_texture_j(cause(EnergyCause::kTexture));
  out.set_moving_j(cause(EnergyCause::kMoving));
  out.set_late_j(late.by_cause_J[static_cast<std::size_t>(EnergyCause::kLate)]);
}

void toProto(const HoldingSnap& snap, proto::HoldingSnap& out) {
  out.set_object(snap.object.object);
  out.set_name(snap.object.name);
  out.set_session(snap.object.session);
  out.set_number(snap.number);
}

void toProto(const TouchSession& session, const ServoView& servo, const ProxyView& proxy, proto::ClientState& out) {
  const Workspace workspace = session.live().workspace();
  out.set_time_s(session.time_s());
  toProto(workspace.toWorld(servo.finger_D), *out.mutable_finger());
  toProto(proxy.proxy, *out.mutable_proxy());
  toProto(servo.force_N, *out.mutable_force_n());
  for (std::size_t i = 0; i < proxy.touched.size(); ++i) {
    proto::TouchedObject& touched = *out.add_touched();
    touched.set_object(proxy.touched[i].object);
    touched.set_name(proxy.touched[i].name);
    touched.set_session(proxy.touched[i].session);
    toProto(proxy.contacts[i], *touched.mutable_plane());
  }
  if (proxy.snap.object.key != 0) toProto(proxy.snap, *out.mutable_snap());
  out.set_safety(static_cast<proto::SafetyState>(servo.safety));
  if (servo.safety == SafetyState::kFault) out.set_fault(faultText(servo.fault));
  toProto(servo.loop, session.servoTotals(), *out.mutable_servo());
  toProto(proxy.loop, session.proxyTotals(), *out.mutable_proxy_loop());
  toProto(proxy.ledger, servo.late, session.live().ledger(), *out.mutable_ledger());
  toProto(servo.vibration, *out.mutable_vibration());
  out.set_buttons(servo.buttons);
  setStylus(servo.stylus, session.deviceInfo(), out);
  setEndings(proxy.ended, out);
  out.set_hand_firm(session.hand().firm());
  out.set_proxy_radius(session.live().radius_W());
  toProto(workspace.origin_W, *out.mutable_workspace()->mutable_origin());
  out.mutable_workspace()->set_world_per_device(workspace.world_per_device);
}

void addMoments(const TouchSession& session, std::uint64_t& next, proto::ClientState& out) {
  const LogRing<ServoMoment>& moments = session.moments();
  const Workspace workspace = session.live().workspace();
  const std::uint64_t end = moments.pushed();
  if (end - next > moments.room()) next = end - moments.room();
  for (ServoMoment moment; next < end; ++next) {
    if (!moments.read(next, moment)) continue;  // the servo has passed it meanwhile
    proto::DeviceSample& sample = *out.add_samples();
    sample.set_time_s(session.time_s(moment.time_ns));
    toProto(workspace.toWorld(moment.finger_D), *sample.mutable_finger());
    toProto(moment.force_N, *sample.mutable_force_n());
    sample.set_buttons(static_cast<std::uint32_t>(moment.buttons));
    setStylus(moment.stylus, session.deviceInfo(), sample);
  }
}

}  // namespace hl
