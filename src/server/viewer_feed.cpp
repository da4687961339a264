#include "server/viewer_feed.h"

#include <hl.pb.h>

#include <span>

#include "base/clock.h"
#include "server/page_scene.h"
#include "server/wire_bytes.h"

namespace hl {

namespace {

constexpr std::uint32_t kProtocolVersion = 2;
constexpr int kMaxSamples = 100;

std::string hello(const TouchSession& session, const std::string& version) {
  proto::ServerMessage message;
  proto::Hello& out = *message.mutable_hello();
  out.set_protocol_version(kProtocolVersion);
  out.set_server_version(version);
  out.set_scene_name(session.snapshot()->name);
  const DeviceInfo& info = session.deviceInfo();
  proto::DeviceInfo& device = *out.mutable_device();
  device.set_name(info.name);
  device.set_force_max_n(info.force_max_N);
  device.set_stiffness_n_m(session.stiffness_N_m());
  device.set_stiffness_max_n_m(info.stiffness_max_N_m);
  device.set_damping_ns_m(session.settings().damping_Ns_m.value_or(info.damping_Ns_m));
  device.set_servo_rate_hz(session.settings().servo_rate_Hz);
  device.set_proxy_rate_hz(session.settings().proxy_rate_Hz);
  return message.SerializeAsString();
}

void setLoop(proto::LoopStats* out, const LoopSummary& loop, const LoopTotals& totals) {
  out->set_rate_hz(loop.rate_Hz);
  out->set_time_p50_us(1e-3 * static_cast<double>(loop.p50_ns));
  out->set_time_p999_us(1e-3 * static_cast<double>(loop.p999_ns));
  out->set_time_max_us(1e-3 * static_cast<double>(loop.max_ns));
  out->set_deadlines_missed(totals.missed);
  out->set_steps(totals.steps);
}

void setContacts(proto::State& state, const ProxyView& proxy) {
  for (const ProxyContact& contact : proxy.contacts) {
    proto::ContactPlane& plane = *state.add_contacts();
    set(plane.mutable_point(), contact.point);
    set(plane.mutable_normal(), contact.normal);
    plane.set_multiplier_m(contact.multiplier_m);
    plane.set_static_friction(contact.static_friction);
    plane.set_stiffness(contact.stiffness);
  }
}

void setSamples(proto::State& state, TouchSession& session) {
  TouchSample sample;
  while (session.popSample(sample)) {
    if (state.samples_size() >= kMaxSamples) continue;
    proto::Sample& out = *state.add_samples();
    out.set_time_s(sample.time_s);
    out.set_force_n(sample.force_N);
    out.set_penetration_m(sample.penetration_m);
    out.set_tick_us(sample.tick_us);
  }
}

// The proxy's ledger and the servo's, which books late hand-over, as one.
void setLedger(proto::Ledger& out, const Ledger& ledger, const Ledger& late, LedgerMode mode) {
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

void setSurfaces(proto::Surfaces& out, const MaterialOverride& surfaces) {
  if (surfaces.stiffness) out.set_stiffness(*surfaces.stiffness);
  if (surfaces.static_friction) out.set_static_friction(*surfaces.static_friction);
  if (surfaces.dynamic_friction) out.set_dynamic_friction(*surfaces.dynamic_friction);
  if (surfaces.viscosity_Ns_m) out.set_viscosity_ns_m(*surfaces.viscosity_Ns_m);
  if (surfaces.smooth) out.set_smooth(*surfaces.smooth);
  out.set_textures(surfaces.textures);
}

MaterialOverride surfacesOf(const proto::Surfaces& in) {
  MaterialOverride surfaces;
  if (in.has_stiffness()) surfaces.stiffness = in.stiffness();
  if (in.has_static_friction()) surfaces.static_friction = in.static_friction();
  if (in.has_dynamic_friction()) surfaces.dynamic_friction = in.dynamic_friction();
  if (in.has_viscosity_ns_m()) surfaces.viscosity_Ns_m = in.viscosity_ns_m();
  if (in.has_smooth()) surfaces.smooth = in.smooth();
  surfaces.textures = !in.has_textures() || in.textures();
  return surfaces;
}

std::string state(TouchSession& session, PageScene& scene) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  proto::ServerMessage message;
  proto::State& out = *message.mutable_state();
  out.set_time_s(session.time_s());
  set(out.mutable_finger(), session.workspace().toWorld(servo.finger_D));
  set(out.mutable_proxy(), proxy.proxy);
  set(out.mutable_force_n(), servo.force_N);
  setContacts(out, proxy);
  out.set_safety(static_cast<proto::SafetyState>(servo.safety));
  if (servo.safety == SafetyState::kFault) out.set_fault(faultText(servo.fault));
  setLoop(out.mutable_servo(), servo.loop, session.servoTotals());
  setLoop(out.mutable_proxy_loop(), proxy.loop, session.proxyTotals());
  setSamples(out, session);
  out.set_exploring(session.exploring());
  out.set_iteration_caps(proxy.capped);
  out.set_hand_firm(session.handFirm());
  out.set_stiffness_n_m(session.stiffness_N_m());
  setLedger(*out.mutable_ledger(), proxy.ledger, servo.late, session.ledger());
  setSurfaces(*out.mutable_surfaces(), session.surfaces());
  out.set_slipping(proxy.slipping);
  out.set_buttons(servo.buttons);
  const std::int64_t now_ns = monotonicNow_ns();
  scene.follow(session.snapshot(), {session.radius_W(), session.workspace().world_per_device}, now_ns);
  scene.describe(out, std::span(proxy.touched.begin(), proxy.touched.end()), now_ns);
  return message.SerializeAsString();
}

void apply(TouchSession& session, const proto::Settings& settings) {
  if (settings.has_explore()) session.setExplore(settings.explore());
  if (settings.has_hand_firm()) session.setHandFirm(settings.hand_firm());
  if (settings.has_stiffness_n_m()) session.setStiffness(settings.stiffness_n_m());
  if (settings.has_surfaces()) session.setSurfaces(surfacesOf(settings.surfaces()));
  if (settings.has_ledger() && proto::LedgerMode_IsValid(settings.ledger()))
    session.setLedger(static_cast<LedgerMode>(settings.ledger()));
}

// A message that does not parse or asks for what does not exist changes nothing.
void receive(TouchSession& session, const std::string& bytes) {
  proto::ViewerMessage message;
  if (!message.ParseFromString(bytes)) return;
  switch (message.body_case()) {
    case proto::ViewerMessage::kHandGoal: {
      const proto::Vec3& p = message.hand_goal().position();
      session.setHandGoal(Vec3(p.x(), p.y(), p.z()));
      break;
    }
    case proto::ViewerMessage::kRelease:
      session.release();
      break;
    case proto::ViewerMessage::kSettings:
      apply(session, message.settings());
      break;
    case proto::ViewerMessage::kRearm:
      session.rearm();
      break;
    case proto::ViewerMessage::kExplore:
      session.setExplore(true);
      break;
    case proto::ViewerMessage::BODY_NOT_SET:
      break;
  }
}

}  // namespace

FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version) {
  const auto scene = std::make_shared<PageScene>();
  const auto openPage = [scene] {
    return [scene, memory = std::make_shared<PageMemory>(scene->open())] { return scene->next(*memory); };
  };
  return {[&session, version] { return hello(session, version); }, openPage,
          [&session, scene] { return state(session, *scene); },
          [&session](const std::string& bytes) { receive(session, bytes); }};
}

}  // namespace hl
