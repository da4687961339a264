#include "wire/websocket.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "wire/stream.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

namespace {

constexpr auto kOutcome = asio::as_tuple(asio::use_awaitable);

}  // namespace

class Websocket::Impl : public websocket::stream<Stream&> {
 public:
  using websocket::stream<Stream&>::stream;
};

Websocket::Websocket(Stream& stream) : impl_(std::make_unique<Impl>(stream)) {}
Websocket::~Websocket() = default;

void Websocket::setTimeout(const websocket::stream_base::timeout& timeout) { impl_->set_option(timeout); }
void Websocket::setReadLimit(std::size_t bytes) { impl_->read_message_max(bytes); }
void Websocket::setPieceSize(std::size_t bytes) { impl_->write_buffer_bytes(bytes); }
void Websocket::setText(bool text) { impl_->text(text); }
bool Websocket::gotText() const { return impl_->got_text(); }
bool Websocket::isMessageDone() const { return impl_->is_message_done(); }
std::string Websocket::peerReason() const { return impl_->reason().reason.c_str(); }

Websocket::Outcome Websocket::accept(const http::request<http::string_body>& request) {
  return impl_->async_accept(request, kOutcome);
}

Websocket::Outcome Websocket::shakeHands(websocket::response_type& response, const std::string& host,
                                         const std::string& target) {
  return impl_->async_handshake(response, host, target, kOutcome);
}

Websocket::Transfer Websocket::readSome(beast::flat_buffer& buffer, std::size_t most_bytes) {
  return impl_->async_read_some(buffer, most_bytes, kOutcome);
}

Websocket::Transfer Websocket::read(beast::flat_buffer& buffer) { return impl_->async_read(buffer, kOutcome); }

Websocket::Transfer Websocket::write(asio::const_buffer message) { return impl_->async_write(message, kOutcome); }

Websocket::Outcome Websocket::close(const websocket::close_reason& reason) {
  return impl_->async_close(reason, kOutcome);
}

}  // namespace hl
