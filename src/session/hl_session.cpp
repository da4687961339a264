#include "session/hl_session.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "io/decode_volumes.h"
#include "session/body_commands.h"
#include "session/contact_report.h"
#include "session/message_forms.h"
#include "session/state_messages.h"
#include "session/stylus_messages.h"
#include "wire/protocol_version.h"

namespace hl {

namespace {

constexpr std::size_t kMaxWaitingFrames = 64;  // that are not built yet
constexpr std::size_t kMaxRefusedUploads = 1000;
constexpr std::size_t kMaxNameLength = 100;

// What a log shows of a name.
std::string plainText(std::string name) {
  name.resize(std::min(name.size(), kMaxNameLength));
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

Workspace workspaceOf(const proto::DeviceSettings& settings) {
  return {vecOf(settings.workspace().origin()), settings.workspace().world_per_device()};
}

// What cannot be set, or empty.
std::string faultOf(const proto::DeviceSettings& settings, bool has_hand) {
  if (settings.has_workspace() && !workspaceOf(settings).valid())
    return "world_per_device must be 1e-9 to 1e9, and the origin within 1e9 m";
  if (settings.has_proxy_radius() && !Workspace::validRadius(settings.proxy_radius()))
    return "proxy_radius must be 1e-12 to 1e9 m";
  if (settings.has_stiffness_n_m() && !(settings.stiffness_n_m() >= 0)) return "stiffness_N_m must not be below 0";
  if (settings.has_ledger() && !proto::LedgerMode_IsValid(settings.ledger()))
    return "ledger must be TANK, STRICT or REPORT";
  if ((settings.has_hand_goal() || settings.has_hand_firm() || settings.has_hand_turn()) && !has_hand)
    return "a person holds the device; only a simulated hand can be moved";
  if (settings.has_hand_goal() && !vecOf(settings.hand_goal().position()).allFinite())
    return "hand_goal.position must hold finite numbers";
  return faultOfTurn(settings.hand_turn());
}

}  // namespace

HlSession::HlSession(TouchWorld& world, std::uint32_t number, WakeSession wake,
                     std::function<void(const HlSession&)> leave)
    : world_(world),
      number_(number),
      leave_(std::move(leave)),
      memory_(world.memory().member()),
      replies_(memory_, std::move(wake)),
      uploads_(memory_, world.limits().upload_bytes),
      bodies_(number),
      frame_rate_(world.limits().frames_Hz) {}

HlSession::~HlSession() {
  leave_(*this);
  world_.giveUpMaster(number_);
  if (!place_) return;
  world_.clients().detach(place_);
  const auto replaced = world_.clients().takeReplaced(place_);
  if (replaced) world_.keep(client_name_, replaced);  // this client has shown nothing in their place
  if (keep_objects_ && !replaced) {
    world_.keep(client_name_, place_);
  } else {
    world_.clients().remove(place_);
  }
}

void HlSession::receive(proto::ClientMessage message) {
  if (!end().empty()) return;
  if (!opened_ && message.body_case() != proto::ClientMessage::kOpen) return end("the first message must be open");
  switch (message.body_case()) {
    case proto::ClientMessage::kOpen:
      return open(message.open());
    case proto::ClientMessage::kUpload:
      return keepUpload(std::move(*message.mutable_upload()));
    case proto::ClientMessage::kUploads:
      return keepUploads(std::move(*message.mutable_uploads()));
    case proto::ClientMessage::kFrame:
      return submit(std::move(*message.mutable_frame()));
    case proto::ClientMessage::kStateRate:
      return setStateRate(message.state_rate().rate_hz());
    case proto::ClientMessage::kDevice:
      return setDevice(message.device());
    case proto::ClientMessage::kSampleRequest:
      return want(message.sample_request().wanted(), next_.sample);
    case proto::ClientMessage::kContactReportRequest:
      return want(message.contact_report_request().wanted(), next_.contact);
    case proto::ClientMessage::kBodyRequest:
      return wantBodies(message.body_request());
    case proto::ClientMessage::kBodyCommand:
      return act(message.body_command());
    case proto::ClientMessage::kBodyCommands:
      return act(message.body_commands());
    case proto::ClientMessage::kIso:
      return setIso(message.iso());
    case proto::ClientMessage::BODY_NOT_SET:
      return refuse("a message with nothing in it that this server knows");
  }
}

void HlSession::open(const proto::Open& open) {
  if (opened_) return refuse("this session is open already");
  if (open.protocol_version() != kProtocolVersion)
    return end("this server speaks version " + std::to_string(kProtocolVersion) + " of the protocol, the client " +
               std::to_string(open.protocol_version()));
  const std::optional<std::uint32_t> device = chosenDevice(open);
  if (!device) return end(missingDevice(open));
  opened_ = true;
  client_name_ = plainText(open.client_name());
  keep_objects_ = open.keep_objects();
  device_ = *device;
  master_ = open.master() && world_.becomeMaster(device_, number_);
  place_ = world_.clients().join(number_, world_.limits(), memory_, callbacks(), world_.takeKept(client_name_));
  proto::ServerReply reply;
  proto::Welcome& welcome = *reply.mutable_welcome();
  welcome.set_protocol_version(kProtocolVersion);
  welcome.set_server_version(world_.settings().version);
  welcome.set_session(number_);
  welcome.set_master(master_);
  welcome.set_device(device_);
  for (std::uint32_t i = 0; i < world_.devices(); ++i) toProto(world_.device(i), *welcome.add_devices());
  *welcome.mutable_limits() = toProto(world_.limits());
  replies_.push(std::move(reply));
  setStateRate(open.state_rate_hz());
}

std::optional<std::uint32_t> HlSession::chosenDevice(const proto::Open& open) const {
  if (!open.device_label().empty()) return world_.deviceNamed(open.device_label());
  if (open.device() < world_.devices()) return open.device();
  return {};
}

std::string HlSession::missingDevice(const proto::Open& open) const {
  const std::string& label = open.device_label();
  std::string there;
  for (std::uint32_t i = 0; i < world_.devices(); ++i) {
    const std::string& name = world_.device(i).label().name;
    there += (i == 0 ? "" : ", ") + std::to_string(i) + (name.empty() ? "" : " (" + name + ")");
  }
  return "there is no device " + (label.empty() ? std::to_string(open.device()) : "'" + plainText(label) + "'") +
         "; the server has " + std::to_string(world_.devices()) + ": " + there;
}

// A message holds millions of parts that are empty: no more of them are answered than a client may leave unread.
void HlSession::keepUploads(proto::Uploads uploads) {
  for (proto::Upload& upload : *uploads.mutable_parts()) {
    if (!end().empty()) return;
    keepUpload(std::move(upload));
  }
}

void HlSession::keepUpload(proto::Upload upload) {
  const std::uint64_t id = upload.id();
  if (id == 0) return refuse("an upload needs an id above 0");
  if (uploads_.refused(id)) return;
  if (uploads_.tooLarge(upload))
    return end("more than " + std::to_string(world_.limits().upload_bytes) +
               " bytes of memory are in uploads that no frame has used");
  try {
    uploads_.add(std::move(upload));
  } catch (const Error& error) {
    return refuseUpload(id, error.what());
  }
}

void HlSession::refuseUpload(std::uint64_t id, const std::string& why) {
  uploads_.refuse(id);
  if (uploads_.refusals() > kMaxRefusedUploads) return end(why);
  refuse("upload " + std::to_string(id) + ": " + why);
}

void HlSession::submit(proto::Frame frame) {
  const std::uint64_t number = frame.number();
  if (number <= last_frame_)
    return refuse("frames must have rising numbers; the last was " + std::to_string(last_frame_) +
                      (number == 0 ? ", and this one has none" : ""),
                  number);
  last_frame_ = number;
  if (!frame_rate_.allow(monotonicNow_ns())) return refuse("frames come faster than the server's limit", number);
  if (world_.clients().waiting(place_) >= kMaxWaitingFrames)
    return refuse("frames come faster than they can be built", number);
  MemoryShare memory(memory_);
  Uploads uploads = uploads_.take(frame, memory);
  try {
    memory.take(bytesOfMessage(frame.SpaceUsedLong()));
  } catch (const Error& error) {
    return refuse(error.what(), number);
  }
  world_.clients().submit(place_, std::move(frame), std::move(uploads), std::move(memory), next_.contact.has_value());
}

// Nothing of them is set when one is wrong.
void HlSession::setDevice(const proto::DeviceSettings& settings) {
  TouchSession& device = world_.device(device_);
  if (!master_)
    return refuse(world_.hasMaster(device_) ? "another client is the device's master"
                                            : "only the device's master sets it, and there is none: the first client "
                                              "whose Open says master is");
  if (const std::string fault = faultOf(settings, device.hasHand()); !fault.empty()) return refuse(fault);
  if (settings.has_workspace()) device.live().setWorkspace(workspaceOf(settings));
  if (settings.has_proxy_radius()) device.live().setRadius(settings.proxy_radius());
  if (settings.has_stiffness_n_m()) device.live().setStiffness(settings.stiffness_n_m());
  if (settings.has_ledger()) device.live().setLedger(static_cast<LedgerMode>(settings.ledger()));
  if (settings.rearm()) device.live().rearm();
  if (settings.has_hand_firm()) device.hand().setFirm(settings.hand_firm());
  if (settings.has_hand_goal()) device.hand().setGoal(vecOf(settings.hand_goal().position()));
  if (settings.has_hand_turn()) turnHand(settings.hand_turn(), device);
}

void HlSession::setStateRate(double rate_Hz) {
  if (!(rate_Hz >= 0)) return refuse("state_rate_Hz must not be below 0");
  states_ = {rate_Hz > 0 ? 1 / std::min(rate_Hz, world_.limits().state_rate_Hz) : 0, world_.time_s()};
}

// From now on.
void HlSession::want(bool wanted, std::optional<std::uint64_t>& next) const {
  if (!wanted) {
    next.reset();
  } else if (!next) {
    next = world_.device(device_).moments().pushed();
  }
}

void HlSession::wantBodies(const proto::BodyRequest& request) {
  const double above_N_s = request.impacts_above_n_s();
  if (!(above_N_s >= 0)) return refuse("body_request: impacts_above_N_s must be a number, and not below 0");
  bodies_.want(request.wanted());
  bodies_.wantEvents(request.events() ? std::optional(above_N_s) : std::nullopt);
}

void HlSession::act(const proto::BodyCommand& message) {
  try {
    BodyCommand command = toBodyCommand(message);
    bodies_.follow(*world_.device(device_).snapshot());
    const std::optional<std::uint32_t> name =
        message.has_name() ? std::optional<std::uint32_t>(message.name()) : std::nullopt;
    const std::vector<std::uint64_t> keys = bodies_.keysOf(message.object(), name);
    if (keys.empty())
      throw Error("body_command: no body of object " + std::to_string(message.object()) +
                  (name ? " and name " + std::to_string(*name) : "") + " that moves is shown");
    for (const std::uint64_t key : keys) {
      command.key = key;
      if (!world_.device(device_).actOnBody(command))
        throw Error("body_command: they come faster than the loops take them");
    }
  } catch (const Error& error) {
    refuse(error.what());
  }
}

void HlSession::act(const proto::BodyCommands& message) {
  if (message.commands_size() > kMaxCommandsPerMessage)
    return refuse("body_commands: there are more than " + std::to_string(kMaxCommandsPerMessage) + " commands");
  for (const proto::BodyCommand& command : message.commands()) act(command);
}

void HlSession::setIso(const proto::IsoChange& change) {
  try {
    world_.publisher().setIso(change.surface(), isoChoiceOf(change));
  } catch (const Error& error) {
    refuse(error.what());
  }
}

// Messages that there is no memory to decode: as when they had been, and had not fitted.
void HlSession::refuse(const proto::ClientMessage& outline, const std::string& why) {
  if (!end().empty()) return;
  if (outline.has_frame()) {
    last_frame_ = std::max(last_frame_, outline.frame().number());
    return refuse(why, outline.frame().number());
  }
  if (outline.has_upload()) return refuseUpload(outline.upload().id(), why);
  if (!outline.has_uploads()) return refuse(why);
  for (const proto::Upload& upload : outline.uploads().parts()) {
    if (end().empty() && !uploads_.refused(upload.id())) refuseUpload(upload.id(), why);
  }
}

void HlSession::refuse(const std::string& why, std::uint64_t frame) {
  proto::ServerReply reply;
  reply.mutable_refusal()->set_text(oneLine(why));
  reply.mutable_refusal()->set_frame(frame);
  replies_.push(std::move(reply));
}

void HlSession::notify(const proto::Event& event) {
  proto::ServerReply reply;
  *reply.mutable_event() = event;
  replies_.push(std::move(reply));
}

FrameCallbacks HlSession::callbacks() {
  FrameCallbacks callbacks;
  callbacks.progress = [this](std::uint64_t number, double part) { replies_.pushProgress(number, part); };
  callbacks.shown = [this](std::uint64_t number, std::size_t primitives, const std::vector<std::string>& warnings) {
    proto::ServerReply reply;
    proto::FrameShown& shown = *reply.mutable_frame_shown();
    shown.set_number(number);
    shown.set_time_s(world_.time_s());
    shown.set_primitives(primitives);
    for (const std::string& warning : warnings) shown.add_warnings(warning);
    replies_.push(std::move(reply));
  };
  callbacks.refused = [this](std::uint64_t number, const std::string& why) { refuse(why, number); };
  return callbacks;
}

bool HlSession::take(proto::ServerReply& reply) {
  if (replies_.take(reply)) return true;
  if (!end().empty() || nextState_s() > 0) return false;
  reply.Clear();
  next_.reported = next_.contact && !next_.reported;
  if (next_.reported) {
    reportContacts(world_.device(device_), *next_.contact, *reply.mutable_contact_report());
    return true;
  }
  const double now_s = world_.time_s();
  // At the rate asked for, without catching up on what was missed.
  states_.next_s = std::max(states_.next_s + states_.period_s, now_s);
  world_.describe(device_, *reply.mutable_state());
  reply.mutable_state()->set_master(master_);
  if (next_.sample) addMoments(world_.device(device_), *next_.sample, *reply.mutable_state());
  if (bodies_.wanted()) {
    bodies_.follow(*world_.device(device_).snapshot());
    bodies_.describe(*reply.mutable_state());
  }
  return true;
}

double HlSession::nextState_s() const {
  if (states_.period_s == 0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, states_.next_s - world_.time_s());
}

}  // namespace hl
