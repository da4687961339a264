#include "page/viewer_feed.h"

#include <hl.pb.h>

#include <span>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/utf8.h"
#include "io/decode_volumes.h"
#include "io/vec_messages.h"
#include "page/page_holds.h"
#include "page/page_scene.h"
#include "session/hand_messages.h"
#include "session/state_messages.h"
#include "session/stylus_messages.h"

namespace hl {

namespace {

constexpr std::uint32_t kProtocolVersion = 2;
constexpr int kMaxSamples = 100;

void describe(const QuantityInfo& info, proto::QuantityInfo& out) {
  out.set_field(proto::Surfaces::descriptor()->FindFieldByName(info.field)->json_name());
  out.set_name(plainName(info));
  out.set_unit(info.unit);
  out.set_usual(info.usual);
  out.set_otherwise(info.otherwise);
  out.set_words(info.words);
}

std::string hello(const TouchSession& session, const ViewerFeedSettings& settings, const std::string& version) {
  proto::ServerMessage message;
  proto::Hello& out = *message.mutable_hello();
  out.set_protocol_version(kProtocolVersion);
  out.set_server_version(version);
  out.set_upload_bytes(settings.upload_bytes);
  out.set_scene_name(printable(session.snapshot()->name));
  toProto(session, *out.mutable_device());
  if (!settings.others.empty()) toProto(session, *out.add_devices());
  for (const TouchSession* other : settings.others) toProto(*other, *out.add_devices());
  for (const QuantityInfo& info : kQuantityInfo) {
    if (info.usual > 0) describe(info, *out.add_quantities());
  }
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

const google::protobuf::FieldDescriptor& fieldOf(const proto::Surfaces& surfaces, std::size_t number) {
  return *surfaces.GetDescriptor()->FindFieldByName(kQuantityInfo[number].field);
}

void setSurfaces(proto::Surfaces& out, const MaterialOverride& surfaces) {
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (surfaces.number(i)) out.GetReflection()->SetDouble(&out, &fieldOf(out, i), *surfaces.number(i));
  }
  if (surfaces.smooth) out.set_smooth(*surfaces.smooth);
  out.set_textures(surfaces.textures);
}

MaterialOverride surfacesOf(const proto::Surfaces& in) {
  MaterialOverride surfaces;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const auto& field = fieldOf(in, i);
    if (in.GetReflection()->HasField(in, &field)) surfaces.number(i) = in.GetReflection()->GetDouble(in, &field);
  }
  if (in.has_smooth()) surfaces.smooth = in.smooth();
  surfaces.textures = !in.has_textures() || in.textures();
  return surfaces;
}

void setRecording(proto::PageRecording& out, const PageRecordingStatus& status) {
  out.set_phase(static_cast<proto::PageRecording::Phase>(status.phase));
  out.set_owner(status.owner);
  out.set_time_s(status.time_s);
  out.set_bytes(status.bytes);
  out.set_text(status.text);
  out.set_max_time_s(PageRecordings::kMaxTime_s);
  out.set_max_bytes(PageRecordings::kMaxBytes);
}

void setBodies(proto::Bodies& out, const BodyView& bodies) {
  out.set_count(bodies.bodies);
  out.set_awake(bodies.awake);
  out.set_kinetic_j(bodies.kinetic_J);
  out.set_gravity_j(bodies.gravity_J);
  out.set_spring_j(bodies.spring_J);
  out.set_by_hand_j(bodies.energy.by_hand_J);
  out.set_contact_j(bodies.energy.contact_J);
  out.set_friction_j(bodies.energy.friction_J);
  out.set_joints_j(bodies.energy.joint_J());
  out.set_solver_j(bodies.energy.solver_J);
  out.set_lost_s(bodies.lost_s);
  out.set_returned(bodies.returned);
}

void setOther(TouchSession& session, proto::OtherDevice& out) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  toProto(session, servo, proxy, out);
}

void setShared(const ShareView& view, proto::State& out) {
  proto::SharedWorld& shared = *out.mutable_shared();
  shared.set_world(view.world);
  shared.set_name(view.name);
  shared.set_ended(view.ended);
  shared.set_objects(view.counts.items - view.counts.own_items);
  shared.set_own(view.counts.own_items);
  shared.set_fetching(view.counts.fetching);
  for (const PeerView& peer : view.peers) {
    proto::SharePeer& entry = *shared.add_peers();
    entry.set_name(peer.name);
    entry.set_round_trip_ms(peer.round_trip_ms);
    entry.set_playout_ms(peer.playout_ms);
  }
  for (const proto::OtherDevice& hand : view.hands) *out.add_remote() = hand;
}

// The devices that pages move, and who of them holds what.
class PageHands {
 public:
  PageHands(TouchSession& first, const std::vector<TouchSession*>& others)
      : sessions_(others), holds_([this](std::size_t device, PageHolds::What what) { letGo(device, what); }) {
    sessions_.insert(sessions_.begin(), &first);
  }

  TouchSession* device(std::size_t number) const { return number < sessions_.size() ? sessions_[number] : nullptr; }
  PageHolds& holds() { return holds_; }

 private:
  void letGo(std::size_t device, PageHolds::What what) const {
    if (what == PageHolds::What::kHand) {
      sessions_[device]->hand().release();
    } else {
      sessions_[device]->hand().press(0);
    }
  }

  std::vector<TouchSession*> sessions_;
  PageHolds holds_;
};

std::string state(TouchSession& session, const ViewerFeedSettings& settings, PageScene& scene) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  proto::ServerMessage message;
  proto::State& out = *message.mutable_state();
  out.set_time_s(session.time_s());
  toProto(session.live().workspace().toWorld(servo.finger_D), *out.mutable_finger());
  toProto(proxy.proxy, *out.mutable_proxy());
  toProto(servo.force_N, *out.mutable_force_n());
  for (const ProxyContact& contact : proxy.contacts) toProto(contact, *out.add_contacts());
  out.set_safety(static_cast<proto::SafetyState>(servo.safety));
  if (servo.safety == SafetyState::kFault) out.set_fault(faultText(servo.fault));
  toProto(servo.loop, session.servoTotals(), *out.mutable_servo());
  toProto(proxy.loop, session.proxyTotals(), *out.mutable_proxy_loop());
  setSamples(out, session);
  out.set_exploring(session.hand().exploring());
  setEndings(proxy.ended, out);
  out.set_hand_firm(session.hand().firm());
  out.set_stiffness_n_m(session.live().stiffness_N_m());
  toProto(proxy.ledger, servo.late, session.live().ledger(), *out.mutable_ledger());
  setSurfaces(*out.mutable_surfaces(), session.live().surfaces());
  out.set_slipping(proxy.slipping);
  toProto(servo.vibration, *out.mutable_vibration());
  out.set_buttons(servo.buttons);
  setStylus(servo.stylus, session.deviceInfo(), out);
  if (proxy.bodies.bodies > 0) setBodies(*out.mutable_bodies(), proxy.bodies);
  if (settings.recordings) setRecording(*out.mutable_recording(), settings.recordings->status());
  for (TouchSession* other : settings.others) setOther(*other, *out.add_others());
  if (settings.share) setShared(settings.share(), out);
  const std::int64_t now_ns = monotonicNow_ns();
  scene.follow(session.snapshot(), {session.live().radius_W(), session.live().workspace().world_per_device}, now_ns);
  scene.describe(out, std::span(proxy.touched.begin(), proxy.touched.end()), proxy.snap, now_ns);
  return message.SerializeAsString();
}

void apply(TouchSession& session, const proto::Settings& settings) {
  if (settings.has_explore()) session.hand().setExplore(settings.explore());
  if (settings.has_hand_firm()) session.hand().setFirm(settings.hand_firm());
  if (settings.has_stiffness_n_m()) session.live().setStiffness(settings.stiffness_n_m());
  if (settings.has_surfaces()) session.live().setSurfaces(surfacesOf(settings.surfaces()));
  if (settings.has_ledger() && proto::LedgerMode_IsValid(settings.ledger()))
    session.live().setLedger(static_cast<LedgerMode>(settings.ledger()));
}

void apply(const SetIso& set_iso, const proto::IsoChange& change) {
  if (!set_iso) return;
  try {
    set_iso(change.surface(), isoChoiceOf(change));
  } catch (const Error&) {  // the surface has gone meanwhile
  }
}

// What moves a hand, or presses its buttons, and who does.
void hold(PageHands& hands, PageNumber page, const proto::ViewerMessage& message) {
  using What = PageHolds::What;
  const bool presses = message.has_press() && message.press().buttons() != 0;
  if (message.has_hand_goal()) hands.holds().take(page, message.device(), What::kHand);
  if (message.has_release()) hands.holds().leave(message.device(), What::kHand);
  if (presses) hands.holds().take(page, message.device(), What::kButtons);
  if (message.has_press() && !presses) hands.holds().leave(message.device(), What::kButtons);
}

// A message that does not parse or asks for what does not exist changes nothing; an empty one says that the page is
// there.
void receive(PageHands& hands, const ViewerFeedSettings& settings, PageNumber page, const std::string& bytes) {
  hands.holds().hear(page, monotonicNow_ns());
  proto::ViewerMessage message;
  if (!message.ParseFromString(bytes)) return;
  TouchSession* const device = hands.device(message.device());
  if (device == nullptr) return;
  hold(hands, page, message);
  TouchSession& session = *device;
  switch (message.body_case()) {
    case proto::ViewerMessage::kHandGoal:
      session.hand().setGoal(vecOf(message.hand_goal().position()));
      break;
    case proto::ViewerMessage::kRelease:
      session.hand().release();
      break;
    case proto::ViewerMessage::kPress:
      session.hand().press(message.press().buttons());
      break;
    case proto::ViewerMessage::kHandTurn:
      if (faultOfTurn(message.hand_turn()).empty()) turnHand(message.hand_turn(), session);
      break;
    case proto::ViewerMessage::kSettings:
      apply(session, message.settings());
      break;
    case proto::ViewerMessage::kRearm:
      session.live().rearm();
      break;
    case proto::ViewerMessage::kExplore:
      session.hand().setExplore(true);
      break;
    case proto::ViewerMessage::kRecord:
      if (settings.recordings)
        settings.recordings->ask(message.record().owner(), message.record().on(), monotonicNow_ns());
      break;
    case proto::ViewerMessage::kIso:
      apply(settings.set_iso, message.iso());
      break;
    case proto::ViewerMessage::BODY_NOT_SET:
      break;
  }
}

}  // namespace

FeedCallbacks makeViewerFeed(TouchSession& session, const std::string& version, ViewerFeedSettings settings) {
  const auto scene = std::make_shared<PageScene>(std::move(settings.memory));
  const auto kept = std::make_shared<const ViewerFeedSettings>(std::move(settings));
  const auto open_page = [scene] {
    return [scene, memory = std::make_shared<PageMemory>(scene->open())] { return scene->next(*memory); };
  };
  const auto hands = std::make_shared<PageHands>(session, kept->others);
  FeedCallbacks feed;
  feed.hello = [&session, kept, version] { return hello(session, *kept, version); };
  feed.scene = open_page;
  feed.state = [&session, kept, scene, hands] {
    hands->holds().letGoOfSilent(monotonicNow_ns());
    return state(session, *kept, *scene);
  };
  feed.receive = [kept, hands](PageNumber page, const std::string& bytes) { receive(*hands, *kept, page, bytes); };
  feed.gone = [hands](PageNumber page) { hands->holds().gone(page); };
  feed.recording = [kept](std::uint32_t owner) { return kept->recordings ? kept->recordings->open(owner) : nullptr; };
  return feed;
}

}  // namespace hl
