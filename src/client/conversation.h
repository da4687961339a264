// Conversation: a context's talk with its server: frames out, replies in. Nothing here waits but open() and finish().
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "client/contact_reports.h"
#include "client/draft.h"
#include "client/error_state.h"
#include "client/event_queue.h"
#include "client/outbox.h"
#include "client/sample_list.h"
#include "client/server_url.h"
#include "client/server_view.h"
#include "client/small_messages.h"
#include "wire/link.h"

namespace hl::client {

class Conversation {
 public:
  /// Waits until the server has welcomed the client. Throws hl::Error with one line that says why it has not.
  static Conversation open(const ServerUrl& url);

  const ServerView& view() const { return view_; }
  const Outbox& outbox() const { return outbox_; }
  bool hasEnded() const { return ended_; }
  /// As given by the server at the beginning or set here since, N/m.
  double springStiffness_N_m() const;

  /// See Outbox.
  void onTakeBack(Outbox::TakeBack take_back) { outbox_.onTakeBack(std::move(take_back)); }
  /// The frame waits until sendFrame().
  void add(Draft&& draft);
  /// Sends the waiting frame if this is the moment; see Outbox.
  Outbox::Outcome sendFrame();
  /// Drops what waits once the conversation has ended.
  void send(proto::DeviceSettings settings);
  void send(const proto::StateRate& rate);
  void send(proto::BodyCommand command);
  /// Asks for samples where there are to be some; 0: none.
  void keepSamples(std::size_t most);
  SampleList& samples() { return samples_; }
  void keepContactReports(bool wanted);
  /// Asks to be notified of the events of bodies from now on.
  void hearBodies();
  ContactReports& contactReports() { return contact_reports_; }
  /// Seconds of Frame.interval_s for the frames to come; empty: left to the server.
  void setInterval(std::optional<double> interval_s) { interval_s_ = interval_s; }

  /// Takes the replies that have arrived. Refusals and the end of the conversation become errors, events wait.
  void takeReplies(ErrorState& errors, EventQueue& events);
  /// Sends what waits and takes replies until everything is answered, the conversation has ended, or the clock
  /// (monotonicNow_ns) shows `until_ns`. True: everything is shown.
  bool finish(std::int64_t until_ns, ErrorState& errors, EventQueue& events);

 private:
  Conversation(std::unique_ptr<Link> link, ServerView view) : link_(std::move(link)), view_(std::move(view)) {}
  void send(proto::ClientMessage&& message);
  void askForBodies();
  void take(proto::ServerReply& reply, ErrorState& errors, EventQueue& events);
  void takeRefusal(const proto::Refusal& refusal, ErrorState& errors);

  std::unique_ptr<Link> link_;
  ServerView view_;
  Outbox outbox_;
  SmallMessages small_;
  SampleList samples_;
  ContactReports contact_reports_;
  std::optional<double> interval_s_;
  std::optional<double> stiffness_N_m_;
  std::uint64_t refusals_ = 0;
  bool ended_ = false, wants_bodies_ = false, hears_bodies_ = false;
};

}  // namespace hl::client
