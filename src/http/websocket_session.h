// WebSocketSession: one HL client at the WebSocket /hl: carries its messages to a ClientSession and the session's
// replies back.
//
//   the server's thread moves bytes:   read ----.                      .---> write, when woken or a state is due
//   the workers do the rest:                    decode -> receive, take -> encode
// Small messages and all replies are light work, on a thread of its own; large messages wait for each other only. Of
// each session one piece of work is under way at a time, and the next of another session comes before its next one: so
// a message that takes long to decode delays its own session and other large messages. Nothing is queued here: the next
// message is read when the last has been taken in, and a state is taken when it can be written.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <memory>
#include <optional>
#include <string>

#include "http/access.h"
#include "http/connection.h"
#include "http/traffic.h"
#include "http/workers.h"
#include "session/client_session.h"
#include "session/limits.h"
#include "session/message_forms.h"
#include "session/message_rate.h"
#include "wire/websocket.h"

namespace hl {

class SessionWaker;

/// What all sessions of a server share; outlives them.
struct WebSocketContext {
  boost::asio::io_context& context;  ///< the server's thread
  Workers& light_workers;
  Workers& heavy_workers;
  SessionHost& host;
  const Access& access;
  const Limits& limits;
  Traffic& traffic;  ///< in the server's thread
};

/// In the server's thread, but for what its comment says.
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
 public:
  /// `trusted`: the connection has shown the token's cookie, so that Open needs no token.
  WebSocketSession(const WebSocketContext& world, ConnectionPointer connection, bool trusted);

  ~WebSocketSession();
  WebSocketSession(const WebSocketSession&) = delete;
  WebSocketSession& operator=(const WebSocketSession&) = delete;

  /// Accepts the WebSocket and serves it until it ends, for whatever reason. Called once.
  boost::asio::awaitable<void> run(boost::beast::http::request<boost::beast::http::string_body> request);

 private:
  // Why this session ends, as reported to the client.
  struct Ending {
    boost::beast::websocket::close_code code = boost::beast::websocket::close_code::normal;
    std::string text;
    bool refusal = false;  // the text is also sent as a fatal Refusal
    RefusedBecause because = RefusedBecause::kFailed;
    std::uint64_t frame = 0;  // that the text is about, if it is one
  };
  // A message on its way in, or the beginning of one that there is no memory for.
  struct Incoming {
    explicit Incoming(const MemoryBudget& budget) : memory(budget) {}
    boost::beast::flat_buffer buffer{};
    MemoryShare memory;  // of the buffer
    std::string no_room{};
  };
  // What the writer has to do next.
  struct Next {
    std::optional<std::string> bytes{};  // to send
    double wait_s = 0;                   // else to wait
    std::string end{};                   // unless the session ends
  };

  bool setUp();
  void end(Ending ending);
  void refuse(boost::beast::websocket::close_code code, RefusedBecause because, std::string text);
  void noteSilence();
  MessageForm formOfMessage();
  void expectOpen();
  class Turn;
  template <typename Work>
  boost::asio::awaitable<std::invoke_result_t<Work>> onSession(Workers& workers, Work work);

  boost::asio::awaitable<void> read();
  boost::asio::awaitable<void> readMessages();
  boost::asio::awaitable<bool> readMessage(Incoming& incoming);
  static bool hasRoom(Incoming& incoming);
  boost::asio::awaitable<void> takeIn(const Incoming& incoming);
  boost::asio::awaitable<void> write();
  boost::asio::awaitable<void> writeMessages();
  boost::asio::awaitable<bool> writeMessage(MessageForm form, const std::string& bytes);
  boost::asio::awaitable<void> sayGoodbye(const Ending& ending);
  boost::asio::awaitable<void> release();

  // In a turn of the session, on a worker.
  std::optional<Ending> handle(MessageForm form, std::string_view bytes);
  std::optional<Ending> open(MessageForm form, proto::ClientMessage message);
  Next next();

  WebSocketContext world_;
  ConnectionPointer connection_;
  Websocket stream_;
  std::shared_ptr<SessionWaker> waker_;
  boost::asio::steady_timer open_deadline_, write_deadline_;
  boost::asio::steady_timer turn_over_;  // cancelled when a turn of the session is over
  bool turn_ = false;                    // a worker has the session
  MessageRate rate_;
  bool trusted_;
  bool opened_ = false;  // Open has been accepted
  bool gone_ = false;    // the connection has ended
  std::optional<Ending> ending_;
  // Of the first message and so of all replies: set before there is a session, then read by workers too.
  MessageForm form_ = MessageForm::kBinary;

  std::unique_ptr<ClientSession> session_;  // of whose turn it is
  MemoryBudget memory_;                     // the session's; set with it, before it is read elsewhere
};

}  // namespace hl
