#include "client/conversation.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/clock.h"
#include "base/duration.h"
#include "base/error.h"
#include "client/open_link.h"
#include "wire/protocol_version.h"

namespace hl::client {

namespace {

// While a frame waits here for the network nobody wakes finish(): it looks again so often.
constexpr std::int64_t kLookAgain_ns = 2'000'000;
constexpr std::int64_t kLongestWait_ns = 1'000'000'000;

proto::ClientMessage openMessage(const ServerUrl& url) {
  proto::ClientMessage message;
  proto::Open& open = *message.mutable_open();
  open.set_protocol_version(kProtocolVersion);
  open.set_client_name(url.name);
  open.set_token(url.token);
  open.set_device(url.device);
  open.set_device_label(url.device_label);
  open.set_master(url.master);
  open.set_keep_objects(url.keep);
  open.set_state_rate_hz(url.state_rate_Hz);
  return message;
}

proto::Welcome awaitWelcome(Link& link, double timeout_s) {
  const std::int64_t until_ns = monotonicNow_ns() + durationOf(timeout_s).count();
  proto::ServerReply reply;
  for (;;) {
    while (link.take(reply)) {
      if (reply.has_refusal()) throw Error(reply.refusal().text());
      if (reply.has_welcome()) return std::move(*reply.mutable_welcome());
    }
    if (!link.ended().empty()) throw Error(link.ended());
    const std::int64_t left_ns = until_ns - monotonicNow_ns();
    if (left_ns <= 0) throw Error("the server has not answered in time");
    link.wait(std::chrono::nanoseconds(left_ns));
  }
}

}  // namespace

Conversation Conversation::open(const ServerUrl& url) {
  std::unique_ptr<Link> link = openLink(url);
  link->send(openMessage(url));
  proto::Welcome welcome = awaitWelcome(*link, url.timeout_s);
  if (welcome.protocol_version() != kProtocolVersion)
    throw Error("the server speaks version " + std::to_string(welcome.protocol_version()) +
                " of the protocol, this library version " + std::to_string(kProtocolVersion));
  const std::uint32_t device = url.device_label.empty() ? url.device : welcome.device();
  ServerView view(std::move(welcome), device);
  if (!url.device_label.empty() && view.device().label() != url.device_label)
    throw Error("the server is older than names of devices: choose one by its number, device=0");
  return {std::move(link), std::move(view)};
}

double Conversation::springStiffness_N_m() const {
  const double said = stiffness_N_m_.value_or(view_.device().stiffness_n_m());
  const double most = view_.device().stiffness_max_n_m();
  return most > 0 ? std::min(said, most) : said;  // 0: not known
}

void Conversation::send(proto::ClientMessage&& message) {
  if (!ended_) small_.send(*link_, std::move(message));
}

Outbox::Outcome Conversation::sendFrame() {
  if (ended_) return Outbox::Outcome::kNothingToSend;
  return outbox_.trySend(*link_, view_.limits(), interval_s_);
}

void Conversation::send(proto::DeviceSettings settings) {
  if (settings.has_stiffness_n_m()) stiffness_N_m_ = settings.stiffness_n_m();
  proto::ClientMessage message;
  *message.mutable_device() = std::move(settings);
  send(std::move(message));
}

void Conversation::send(const proto::StateRate& rate) {
  proto::ClientMessage message;
  *message.mutable_state_rate() = rate;
  send(std::move(message));
}

void Conversation::send(proto::BodyCommand command) {
  proto::ClientMessage message;
  *message.mutable_body_command() = std::move(command);
  send(std::move(message));
}

// From the first body on the states hold bodies.
void Conversation::add(Draft&& draft) {
  if (draft.hasBodies() && !std::exchange(wants_bodies_, true)) askForBodies();
  outbox_.add(std::move(draft));
}

void Conversation::hearBodies() {
  if (!std::exchange(hears_bodies_, true)) askForBodies();
}

void Conversation::askForBodies() {
  proto::ClientMessage message;
  message.mutable_body_request()->set_wanted(wants_bodies_);
  message.mutable_body_request()->set_events(hears_bodies_);
  send(std::move(message));
}

void Conversation::keepSamples(std::size_t most) {
  samples_.keep(most);
  proto::ClientMessage message;
  message.mutable_sample_request()->set_wanted(most > 0);
  send(std::move(message));
}

void Conversation::keepContactReports(bool wanted) {
  contact_reports_.keep(wanted);
  proto::ClientMessage message;
  message.mutable_contact_report_request()->set_wanted(wanted);
  send(std::move(message));
}

void Conversation::takeRefusal(const proto::Refusal& refusal, ErrorState& errors) {
  ++refusals_;
  outbox_.refused(refusal.frame());
  const std::string frame = refusal.frame() == 0 ? "" : "frame " + std::to_string(refusal.frame()) + ": ";
  errors.note(HL_REFUSED, nullptr, "refused by the server: " + frame + refusal.text());
}

void Conversation::take(proto::ServerReply& reply, ErrorState& errors, EventQueue& events) {
  switch (reply.body_case()) {
    case proto::ServerReply::kRefusal:
      return takeRefusal(reply.refusal(), errors);
    case proto::ServerReply::kProgress:
      return view_.take(reply.progress());
    case proto::ServerReply::kFrameShown:
      outbox_.shown(reply.frame_shown().number());
      return view_.take(std::move(*reply.mutable_frame_shown()));
    case proto::ServerReply::kState:
      samples_.add(reply.state());
      reply.mutable_state()->clear_samples();
      events.pushMotion(reply.state());
      return view_.take(std::move(*reply.mutable_state()));
    case proto::ServerReply::kEvent:
      return events.push(reply.event());
    case proto::ServerReply::kContactReport:
      return contact_reports_.add(reply.contact_report());
    case proto::ServerReply::kWelcome:  // answered once, by open()
    case proto::ServerReply::BODY_NOT_SET:
      return;
  }
}

void Conversation::takeReplies(ErrorState& errors, EventQueue& events) {
  if (ended_) return;
  small_.sendWaiting(*link_);
  // Asked first: what arrived before the end is still taken.
  const std::string why = link_->ended();
  proto::ServerReply reply;
  while (link_->take(reply)) take(reply, errors, events);
  if (why.empty()) return;
  ended_ = true;
  errors.note(HL_CONNECTION_LOST, nullptr, "the conversation has ended: " + why);
}

bool Conversation::finish(std::int64_t until_ns, ErrorState& errors, EventQueue& events) {
  const std::uint64_t refusals_before = refusals_;
  for (;;) {
    sendFrame();
    takeReplies(errors, events);
    if (ended_) return false;
    if (!outbox_.hasWaiting() && outbox_.allAnswered() && small_.empty()) return refusals_ == refusals_before;
    const std::int64_t left_ns = until_ns - monotonicNow_ns();
    if (left_ns <= 0) return false;
    std::int64_t wait_ns = kLongestWait_ns;
    if (!small_.empty()) wait_ns = kLookAgain_ns;
    if (outbox_.hasWaiting()) wait_ns = std::max(outbox_.untilAllowed_ns(view_.limits()), kLookAgain_ns);
    link_->wait(std::chrono::nanoseconds(std::min(wait_ns, left_ns)));
  }
}

}  // namespace hl::client
