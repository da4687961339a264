// HlCarrier: one HL client at the WebSocket /hl: carries its messages to a ClientSession and the session's replies
// back.
//
//   the server's thread moves bytes:       read ----.                      .---> write, when woken or a state is due
//   a strand of the workers does the rest:          decode -> receive, take -> encode
// So a message that takes long to decode delays its own session only, and the session sees one thread at a time.
// Nothing is queued here: the next message is read when the last has been taken in, and a state is taken when it can be
// written.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <memory>
#include <optional>
#include <string>

#include "server/access.h"
#include "server/client_session.h"
#include "server/connection.h"
#include "server/limits.h"
#include "server/message_forms.h"
#include "server/message_rate.h"
#include "server/traffic.h"
#include "wire/websocket.h"

namespace hl {

class CarrierBell;

/// What all carriers of a server share; outlives them.
struct CarrierWorld {
  boost::asio::io_context& context;  ///< the server's thread
  boost::asio::thread_pool& workers;
  SessionHost& host;
  const Access& access;
  const Limits& limits;
  Traffic& traffic;  ///< in the server's thread
};

/// In the server's thread, but for what its comment says.
class HlCarrier : public std::enable_shared_from_this<HlCarrier> {
 public:
  /// `trusted`: the connection has shown the token's cookie, so that Open needs no token.
  HlCarrier(const CarrierWorld& world, ConnectionPointer connection, bool trusted);

  /// Accepts the WebSocket and serves it until it ends, for whatever reason. Called once.
  boost::asio::awaitable<void> run(boost::beast::http::request<boost::beast::http::string_body> request);

 private:
  // Why this session ends, as the client is told.
  struct Ending {
    boost::beast::websocket::close_code code = boost::beast::websocket::close_code::normal;
    std::string text;
    bool refusal = false;  // the text is also sent as a fatal Refusal
    RefusedBecause because = RefusedBecause::kFailed;
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
  void expectOpen();
  boost::asio::awaitable<void> read();
  boost::asio::awaitable<bool> readMessage(Incoming& incoming);
  static bool hasRoom(Incoming& incoming);
  boost::asio::awaitable<void> takeIn(const Incoming& incoming);
  boost::asio::awaitable<void> write();
  boost::asio::awaitable<bool> writeMessage(MessageForm form, const std::string& bytes);
  boost::asio::awaitable<void> sayGoodbye(const Ending& ending);
  boost::asio::awaitable<void> release();

  // On the strand.
  std::optional<Ending> handle(MessageForm form, std::string_view bytes);
  std::optional<Ending> open(MessageForm form, proto::ClientMessage message);
  Next next();

  CarrierWorld world_;
  ConnectionPointer connection_;
  Websocket stream_;
  boost::asio::strand<boost::asio::thread_pool::executor_type> strand_;
  std::shared_ptr<CarrierBell> bell_;
  boost::asio::steady_timer open_deadline_, write_deadline_;
  MessageRate rate_;
  bool trusted_;
  bool opened_ = false;  // Open has been accepted
  bool gone_ = false;    // the connection has ended
  std::optional<Ending> ending_;
  // Of the first message and so of all replies: set before there is a session, then read on the strand too.
  MessageForm form_ = MessageForm::kBinary;

  std::unique_ptr<ClientSession> session_;  // on the strand
  MemoryBudget memory_;                     // the session's; set with it, before it is read elsewhere
};

}  // namespace hl
