// A client of /hl made of Boost.Beast alone, which sends what a test gives it, right or wrong.
#pragma once

#include <google/protobuf/util/json_util.h>
#include <hl.pb.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hl::test {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using Headers = std::vector<std::pair<http::field, std::string>>;

inline proto::ClientMessage openMessage(double state_rate_Hz = 0, const std::string& token = "") {
  proto::ClientMessage message;
  message.mutable_open()->set_protocol_version(1);
  message.mutable_open()->set_state_rate_hz(state_rate_Hz);
  message.mutable_open()->set_token(token);
  return message;
}

inline proto::ClientMessage frameMessage(std::uint64_t number) {
  proto::ClientMessage message;
  message.mutable_frame()->set_number(number);
  return message;
}

/// Blocking, one thread. Errors throw boost::system::system_error.
class PlainClient {
 public:
  /// `receive_buffer` > 0: bytes that the kernel keeps for a client that does not read.
  explicit PlainClient(std::uint16_t port, const Headers& headers = {}, const std::string& target = "/hl",
                       int receive_buffer = 0)
      : stream_(context_) {
    stream_.next_layer().open(tcp::v4());
    if (receive_buffer > 0) {
      stream_.next_layer().set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer));
    }
    stream_.next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
    stream_.set_option(websocket::stream_base::decorator([headers](websocket::request_type& request) {
      for (const auto& [field, value] : headers) request.set(field, value);
    }));
    stream_.handshake("127.0.0.1:" + std::to_string(port), target);
  }

  void send(const proto::ClientMessage& message) { sendBinary(message.SerializeAsString()); }
  void sendBinary(const std::string& bytes) {
    stream_.binary(true);
    stream_.write(boost::asio::buffer(bytes));
  }
  void sendText(const std::string& text) {
    stream_.text(true);
    stream_.write(boost::asio::buffer(text));
  }
  void sendJson(const proto::ClientMessage& message) {
    std::string text;
    (void)google::protobuf::util::MessageToJsonString(message, &text);
    sendText(text);
  }

  /// The next reply, in whatever form it comes; nothing when the server has ended the session.
  std::optional<proto::ServerReply> next() {
    beast::flat_buffer buffer;
    beast::error_code error;
    stream_.read(buffer, error);
    if (error) return {};
    text_ = beast::buffers_to_string(buffer.data());
    proto::ServerReply reply;
    const bool good = stream_.got_text() ? google::protobuf::util::JsonStringToMessage(text_, &reply).ok()
                                         : reply.ParseFromString(text_);
    if (!good) return {};
    return reply;
  }
  /// Whether another message comes, whatever is in it, before the server ends the connection.
  bool nextBytes() {
    beast::flat_buffer buffer;
    beast::error_code error;
    stream_.read(buffer, error);
    return !error;
  }
  /// The next reply that is no state.
  std::optional<proto::ServerReply> nextAnswer() {
    while (auto reply = next()) {
      if (!reply->has_state()) return reply;
    }
    return {};
  }
  /// Reads until the server has ended the session; its last refusal, if there was one.
  std::string readToEnd() {
    std::string refusal;
    while (auto reply = next()) {
      if (reply->has_refusal() && reply->refusal().fatal()) refusal = reply->refusal().text();
    }
    return refusal;
  }
  /// A frame there and its answer back: the session lives.
  bool isServed(std::uint64_t number) {
    send(frameMessage(number));
    const auto reply = nextAnswer();
    return reply && reply->frame_shown().number() == number;
  }
  unsigned closeCode() const { return stream_.reason().code; }
  std::string closeReason() const { return stream_.reason().reason.c_str(); }
  bool gotText() const { return stream_.got_text(); }
  const std::string& text() const { return text_; }  ///< of the last reply, as it came
  websocket::stream<tcp::socket>& stream() { return stream_; }

 private:
  boost::asio::io_context context_;
  websocket::stream<tcp::socket> stream_;
  std::string text_;
};

/// One plain HTTP request.
inline http::response<http::string_body> request(std::uint16_t port, const std::string& target,
                                                 const Headers& headers = {}, http::verb verb = http::verb::get) {
  boost::asio::io_context context;
  tcp::socket socket(context);
  socket.connect({boost::asio::ip::address_v4::loopback(), port});
  http::request<http::string_body> message(verb, target, 11);
  message.set(http::field::host, "127.0.0.1:" + std::to_string(port));
  for (const auto& [field, value] : headers) message.set(field, value);
  message.keep_alive(false);
  http::write(socket, message);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(verb == http::verb::head);
  http::read(socket, buffer, parser);
  return parser.release();
}

}  // namespace hl::test
