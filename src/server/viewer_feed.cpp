#include "server/viewer_feed.h"

#include <hl.pb.h>

#include <cstring>
#include <vector>

#include "server/feed_messages.h"
#include "server/surface_images.h"

namespace hl {

namespace {

constexpr std::uint32_t kProtocolVersion = 1;
constexpr int kMaxSamples = 100;

template <typename T>
std::string bytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string floatsOf(const std::vector<Vec3>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) {
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(p[i]));
  }
  return bytesOf(values);
}

std::string hello(const TouchSession& session, const std::string& version) {
  proto::ServerMessage message;
  proto::Hello& out = *message.mutable_hello();
  out.set_protocol_version(kProtocolVersion);
  out.set_server_version(version);
  out.set_scene_name(session.snapshot()->name);
  toProto(session, *out.mutable_device());
  return message.SerializeAsString();
}

std::string sceneMesh(const TouchSession& session) {
  const std::shared_ptr<const Snapshot> scene = session.snapshot();
  const Snapshot& snapshot = *scene;
  proto::ServerMessage message;
  proto::SceneMesh& out = *message.mutable_scene();
  if (snapshot.instances.empty()) return message.SerializeAsString();
  out.set_name(snapshot.shape().model.name);
  out.set_positions(floatsOf(snapshot.shape().model.positions));
  out.set_normals(floatsOf(snapshot.shape().model.normals));
  out.set_triangles(bytesOf(snapshot.shape().model.triangles));
  out.set_segments(bytesOf(snapshot.shape().model.segments));
  out.set_points(bytesOf(snapshot.shape().model.points));
  if (!snapshot.bounds.empty()) {
    toProto(snapshot.bounds.min, *out.mutable_bounds_min());
    toProto(snapshot.bounds.max, *out.mutable_bounds_max());
  }
  out.set_proxy_radius(session.radius_W());
  out.set_world_per_device(session.workspace().world_per_device);
  addSurfaceImages(snapshot.shape().model, out);
  return message.SerializeAsString();
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

std::string state(TouchSession& session) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  proto::ServerMessage message;
  proto::State& out = *message.mutable_state();
  out.set_time_s(session.time_s());
  toProto(session.workspace().toWorld(servo.finger_D), *out.mutable_finger());
  toProto(proxy.proxy, *out.mutable_proxy());
  toProto(servo.force_N, *out.mutable_force_n());
  for (const ProxyContact& contact : proxy.contacts) toProto(contact, *out.add_contacts());
  out.set_safety(static_cast<proto::SafetyState>(servo.safety));
  if (servo.safety == SafetyState::kFault) out.set_fault(faultText(servo.fault));
  toProto(servo.loop, session.servoTotals(), *out.mutable_servo());
  toProto(proxy.loop, session.proxyTotals(), *out.mutable_proxy_loop());
  setSamples(out, session);
  out.set_exploring(session.exploring());
  out.set_iteration_caps(proxy.capped);
  out.set_hand_firm(session.handFirm());
  out.set_stiffness_n_m(session.stiffness_N_m());
  toProto(proxy.ledger, servo.late, session.ledger(), *out.mutable_ledger());
  setSurfaces(*out.mutable_surfaces(), session.surfaces());
  out.set_slipping(proxy.slipping);
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
  auto mesh = std::make_shared<const std::string>(sceneMesh(session));
  return {[&session, version] { return hello(session, version); }, [mesh] { return mesh; },
          [&session] { return state(session); }, [&session](const std::string& bytes) { receive(session, bytes); }};
}

}  // namespace hl
