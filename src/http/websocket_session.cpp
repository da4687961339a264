#include "http/websocket_session.h"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <cmath>
#include <exception>
#include <type_traits>
#include <utility>

#include "base/clock.h"
#include "base/duration.h"
#include "base/error.h"
#include "base/guarded_thread.h"
#include "base/utf8.h"
#include "http/session_waker.h"
#include "monitor/event_log.h"
#include "session/message_size.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using websocket::close_code;

namespace {

constexpr std::size_t kPiece_bytes = std::size_t{64} * 1024;  // of a message, from the socket at a time
// Replies in the kernel's hands are replies that grow old: a slow reader shall find new states soon.
constexpr int kSendBuffer_bytes = 64 * 1024;
constexpr double kShortestWait_s =
    1e-4;  // a state that is due but not there yet is asked for at most 10 000 times a second
constexpr double kLongestWait_s = 1;  // without states only the waker wakes, if there was memory for it
// Such a message is decoded in well under a millisecond, in either form.
constexpr std::size_t kLight_bytes = std::size_t{16} * 1024;
constexpr std::size_t kMaxReason_bytes = 123;  // RFC 6455, 5.5: what a close frame holds beside its code

// As much of `text` as fits.
websocket::close_reason closeReason(close_code code, const std::string& text) {
  const std::string_view begin = beginOf(text, kMaxReason_bytes);
  return {code, beast::string_view(begin.data(), begin.size())};
}

proto::ServerReply fatalRefusal(const std::string& text, std::uint64_t frame) {
  proto::ServerReply reply;
  reply.mutable_refusal()->set_text(text);
  reply.mutable_refusal()->set_frame(frame);
  reply.mutable_refusal()->set_fatal(true);
  return reply;
}

}  // namespace

WebSocketSession::WebSocketSession(const WebSocketContext& world, ConnectionPointer connection, bool trusted)
    : world_(world),
      connection_(std::move(connection)),
      stream_(connection_->stream),
      waker_(std::make_shared<SessionWaker>(world.context)),
      open_deadline_(world.context),
      write_deadline_(world.context),
      turn_over_(world.context, asio::steady_timer::time_point::max()),
      rate_(world.limits.messages_Hz),
      trusted_(trusted) {}

// The session is one worker's.
class WebSocketSession::Turn {
 public:
  explicit Turn(WebSocketSession& session) : session_(session) { session_.turn_ = true; }
  ~Turn() {
    session_.turn_ = false;
    session_.turn_over_.cancel();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  WebSocketSession& session_;
};

// Reader and writer take turns: who waits is woken before the other can have finished what it waits for.
template <typename Work>
asio::awaitable<std::invoke_result_t<Work>> WebSocketSession::onSession(Workers& workers, Work work) {
  while (turn_) co_await turn_over_.async_wait(kAwait);
  const Turn turn(*this);
  co_return co_await doOn(workers, std::move(work));
}

bool WebSocketSession::setUp() {
  boost::system::error_code error;
  connection_->stream.tcp().socket().set_option(asio::socket_base::send_buffer_size(kSendBuffer_bytes), error);
  websocket::stream_base::timeout patience{};
  patience.handshake_timeout = durationOf(world_.limits.handshake_s);
  patience.idle_timeout = durationOf(world_.limits.idle_s);
  patience.keep_alive_pings = true;
  stream_.setTimeout(patience);
  // readMessage() counts the bytes, so that it can say why it refuses; here 0 is no limit.
  stream_.setReadLimit(0);
  stream_.setPieceSize(kPiece_bytes);
  return !error;
}

asio::awaitable<void> WebSocketSession::run(http::request<http::string_body> request) {
  using namespace asio::experimental::awaitable_operators;
  const auto self = shared_from_this();
  if (!setUp()) co_return;
  auto [refused] = co_await stream_.accept(request);
  if (refused) co_return;
  connection_->farewell = [weak = weak_from_this()] {
    if (const auto session = weak.lock()) session->end({close_code::going_away, "the server stops", false, {}});
  };
  expectOpen();
  co_await (read() && write());
  open_deadline_.cancel();
  co_await release();
}

// What a session leaves may be large. Without memory to ask a worker it goes here.
asio::awaitable<void> WebSocketSession::release() {
  co_await onSession(world_.heavy_workers, [this] {
    session_.reset();
    return true;
  });
}

WebSocketSession::~WebSocketSession() {
  session_.reset();
  waker_->close();
  if (!opened_) return;
  --world_.traffic.sessions;
  guarded([this] {
    logEvent(LogLevel::kInfo, "session_end",
             {{"peer", connection_->peer}, {"reason", ending_ ? ending_->text : std::string("the connection ended")}});
  });
}

void WebSocketSession::end(Ending ending) {
  if (ending_) return;
  ending_ = std::move(ending);
  waker_->wake();
}

void WebSocketSession::refuse(close_code code, RefusedBecause because, std::string text) {
  end({code, std::move(text), true, because});
}

// Nothing can be sent any more; the log and the counts tell a client that hangs from one that has closed.
void WebSocketSession::noteSilence() {
  if (ending_) return;
  ending_ = Ending{close_code::policy_error, "the client answers no ping", false, RefusedBecause::kSilent};
  world_.traffic.refuse(ending_->because);
  logEvent(LogLevel::kWarning, "refused", {{"peer", connection_->peer}, {"reason", ending_->text}});
}

void WebSocketSession::expectOpen() {
  open_deadline_.expires_after(durationOf(world_.limits.handshake_s));
  open_deadline_.async_wait([weak = weak_from_this()](boost::system::error_code cancelled) {
    const auto session = weak.lock();
    if (cancelled || !session || session->opened_) return;
    session->refuse(close_code::policy_error, RefusedBecause::kSilent, "no Open came in time; send it first");
  });
}

// ---- From the client -----------------------------------------------------------------------------------------------

// Ended by an exception, or dropped where it waited, it leaves a session that nobody listens to: that ends too.
asio::awaitable<void> WebSocketSession::read() {
  const auto end = [this](bool* whole) {
    if (*whole) return;
    gone_ = true;
    connection_->stream.close();
    waker_->wake();
  };
  bool whole = false;
  const std::unique_ptr<bool, decltype(end)> guard(&whole, end);
  co_await readMessages();
  whole = true;
}

asio::awaitable<void> WebSocketSession::readMessages() {
  try {
    while (!ending_) {
      Incoming incoming(memory_);
      const bool whole = co_await readMessage(incoming);
      if (!whole) break;
      if (!rate_.allow(monotonicNow_ns())) {
        refuse(close_code::policy_error, RefusedBecause::kTooFast,
               "too many messages a second; send fewer, larger ones");
        break;
      }
      co_await takeIn(incoming);
    }
  } catch (const std::bad_alloc&) {
    refuse(close_code::internal_error, RefusedBecause::kFailed, "the server has not enough memory for the message");
  }
}

MessageForm WebSocketSession::formOfMessage() { return stream_.gotText() ? MessageForm::kJson : MessageForm::kBinary; }

asio::awaitable<void> WebSocketSession::takeIn(const Incoming& incoming) {
  const MessageForm form = formOfMessage();
  if (!opened_) form_ = form;
  const auto data = incoming.buffer.cdata();
  const std::string_view bytes(static_cast<const char*>(data.data()), data.size());
  Workers& workers = bytes.size() > kLight_bytes ? world_.heavy_workers : world_.light_workers;
  std::optional<Ending> trouble = co_await onSession(workers, [&]() -> std::optional<Ending> {
    if (incoming.no_room.empty()) return handle(form, bytes);
    session_->refuse(outlineOf(bytes), incoming.no_room);
    return {};
  });
  if (trouble) {
    end(std::move(*trouble));
  } else if (!opened_) {
    opened_ = true;
    ++world_.traffic.sessions;
    ++world_.traffic.sessions_opened;
  }
  waker_->wake();
}

// One whole message, or false: the connection has ended, or the message is too large and refused. Of one that there is
// no memory for, the beginning: the rest is read and dropped.
asio::awaitable<bool> WebSocketSession::readMessage(Incoming& incoming) {
  const std::uint64_t most = opened_ ? world_.limits.message_bytes : world_.limits.open_bytes;
  std::uint64_t size = 0;
  incoming.buffer.max_size(most + kPiece_bytes);
  do {
    beast::flat_buffer dropped;
    beast::flat_buffer& buffer = hasRoom(incoming) ? incoming.buffer : dropped;
    auto [error, bytes] = co_await stream_.readSome(buffer, kPiece_bytes);
    if (error) {
      if (error == websocket::condition::protocol_violation) world_.traffic.refuse(RefusedBecause::kMalformed);
      if (error == beast::error::timeout) noteSilence();
      gone_ = true;
      waker_->wake();
      co_return false;
    }
    world_.traffic.bytes_in += bytes;
    size += bytes;
    if (size > most) {
      if (!opened_) form_ = formOfMessage();
      refuse(close_code::too_big, RefusedBecause::kTooLarge,
             "a message of more than " + std::to_string(most) + " bytes; " +
                 (opened_ ? "send large meshes as uploads in parts" : "send Open first"));
      co_return false;
    }
  } while (!stream_.isMessageDone());
  ++world_.traffic.messages_in;
  co_return true;
}

// For another piece; the buffer is copied to one of twice its size when it is full.
bool WebSocketSession::hasRoom(Incoming& incoming) {
  constexpr std::uint64_t kWhileGrowing = 3;
  if (!incoming.no_room.empty()) return false;
  try {
    incoming.memory.takeUpTo(kWhileGrowing * (incoming.buffer.size() + kPiece_bytes));
    return true;
  } catch (const Error& error) {
    incoming.no_room = error.what();
    return false;
  }
}

std::optional<WebSocketSession::Ending> WebSocketSession::handle(MessageForm form, std::string_view bytes) {
  try {
    proto::ClientMessage message;
    MemoryShare memory(memory_);
    auto [fault, no_room, frame] = decodeMessage(form, bytes, message, memory);
    if (!fault.empty())
      return Ending{close_code::bad_payload, std::move(fault), true, RefusedBecause::kMalformed, frame};
    if (!session_) return open(form, std::move(message));
    if (!no_room.empty()) {
      session_->refuse(message, no_room);
      return {};
    }
    session_->receive(std::move(message));
    return {};
  } catch (const std::exception& error) {
    return Ending{close_code::internal_error, std::string("the server failed: ") + error.what(), true,
                  RefusedBecause::kFailed};
  }
}

std::optional<WebSocketSession::Ending> WebSocketSession::open(MessageForm form, proto::ClientMessage message) {
  if (!message.has_open()) {
    return Ending{close_code::policy_error, "the first message must be open", true, RefusedBecause::kMalformed};
  }
  if (!trusted_ && !world_.access.allowsToken(message.open().token())) {
    const bool none = message.open().token().empty();
    return Ending{close_code::policy_error,
                  none ? "this server asks for a token, and none came" : "the token is not this server's", true,
                  RefusedBecause::kAccess};
  }
  message.mutable_open()->clear_token();  // it has done its work: nobody else needs to know it
  try {
    session_ = world_.host.connect([waker = waker_] { waker->wake(); });
  } catch (const Error& error) {
    return Ending{close_code::try_again_later, error.what(), true, RefusedBecause::kFull};
  }
  memory_ = session_->memory();
  logEvent(LogLevel::kInfo, "session_open",
           {{"peer", connection_->peer},
            {"client", message.open().client_name()},
            {"form", form == MessageForm::kJson ? "json" : "binary"}});
  session_->receive(std::move(message));
  if (const std::string why = session_->end(); !why.empty())  // another version, or no such device
    return Ending{close_code::policy_error, why, true, RefusedBecause::kMalformed};
  return {};
}

// ---- To the client -------------------------------------------------------------------------------------------------

WebSocketSession::Next WebSocketSession::next() {
  if (!session_) return {.wait_s = kLongestWait_s};
  try {
    proto::ServerReply reply;
    if (session_->take(reply)) return {.bytes = encodeReply(form_, reply)};
    return {.wait_s = std::clamp(session_->nextState_s(), kShortestWait_s, kLongestWait_s), .end = session_->end()};
  } catch (const std::exception& error) {
    return {.end = std::string("the server failed: ") + error.what()};
  }
}

// Whatever the reader still waits for when this has ended, by whatever way, will not come.
asio::awaitable<void> WebSocketSession::write() {
  const auto close = [](Stream* stream) { stream->close(); };
  const std::unique_ptr<Stream, decltype(close)> guard(&connection_->stream, close);
  co_await writeMessages();
}

asio::awaitable<void> WebSocketSession::writeMessages() {
  while (!gone_) {
    if (ending_) {
      co_await sayGoodbye(*ending_);
      break;
    }
    const Next todo = co_await onSession(world_.light_workers, [this] { return next(); });
    if (todo.bytes) {
      const bool sent = co_await writeMessage(form_, *todo.bytes);
      if (!sent) break;
    } else if (!todo.end.empty()) {
      end({close_code::policy_error, todo.end, false, {}});
    } else {
      co_await waker_->wait(durationOf(todo.wait_s));
    }
  }
}

asio::awaitable<bool> WebSocketSession::writeMessage(MessageForm form, const std::string& bytes) {
  write_deadline_.expires_after(durationOf(world_.limits.write_s));
  write_deadline_.async_wait([weak = weak_from_this()](boost::system::error_code cancelled) {
    const auto session = weak.lock();
    if (cancelled || !session) return;
    session->world_.traffic.refuse(RefusedBecause::kSilent);
    session->end({close_code::policy_error, "the client reads nothing", false, RefusedBecause::kSilent});
    session->connection_->stream.close();
  });
  stream_.setText(form == MessageForm::kJson);
  auto [error, sent] = co_await stream_.write(asio::buffer(bytes));
  write_deadline_.cancel();
  world_.traffic.bytes_out += sent;
  if (!error) ++world_.traffic.messages_out;
  co_return !error;
}

asio::awaitable<void> WebSocketSession::sayGoodbye(const Ending& ending) {
  if (ending.refusal) {
    world_.traffic.refuse(ending.because);
    logEvent(LogLevel::kWarning, "refused", {{"peer", connection_->peer}, {"reason", ending.text}});
    const std::string bytes = encodeReply(form_, fatalRefusal(ending.text, ending.frame));
    const bool sent = co_await writeMessage(form_, bytes);
    if (!sent) co_return;
  }
  co_await stream_.close(closeReason(ending.code, ending.text));
}

}  // namespace hl
