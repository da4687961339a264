#include "client/connect_stream.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/error.hpp>

#include "base/error.h"

namespace hl {

namespace asio = boost::asio;
namespace ssl = asio::ssl;
using asio::ip::tcp;

namespace {

constexpr auto kAwait = asio::as_tuple(asio::use_awaitable);

std::string connectFailure(const ServerAddress& address, const boost::system::error_code& error) {
  const std::string who = address.text();
  if (error == asio::error::connection_refused) return who + " refused the connection; is hld running there?";
  if (error == boost::beast::error::timeout) return who + " does not answer; is the address right and the way open?";
  return "cannot reach " + who + ": " + error.message();
}

const char* adviceFor(long verdict) {
  switch (verdict) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return "renew it on the server";
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return "is the clock of this machine right?";
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return "connect by a name or address that it is made for";
    default:
      return "give the file of its authority (ca=)";
  }
}

std::string tlsFailure(const ServerAddress& address, SSL* handle, const boost::system::error_code& error) {
  const long verdict = SSL_get_verify_result(handle);
  if (verdict != X509_V_OK) {
    return "the certificate of " + address.text() + " is not trusted (" + X509_verify_cert_error_string(verdict) +
           "); " + adviceFor(verdict);
  }
  if (error == boost::beast::error::timeout) return address.text() + " does not answer to TLS; does it want hl:// ?";
  return address.text() + " speaks no TLS 1.3 (" + error.message() +
         "); does it want hl:// ?, or has it no room for another connection?";
}

// The certificate must be this host's; a name is also sent to the server, an address is not (RFC 6066, 3).
void expectHost(SSL* handle, const std::string& host) {
  if (X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(handle), host.c_str()) == 1) return;
  SSL_set1_host(handle, host.c_str());
  SSL_set_tlsext_host_name(handle, host.c_str());
}

asio::awaitable<void> shakeHands(Stream& stream, const ServerAddress& address) {
  Stream::Tls& tls = *stream.tls();
  tls.set_verify_mode(ssl::verify_peer);
  expectHost(tls.native_handle(), address.host);
  auto [error] = co_await tls.async_handshake(ssl::stream_base::client, kAwait);
  if (error) throw Error(tlsFailure(address, tls.native_handle(), error));
}

}  // namespace

std::unique_ptr<ssl::context> makeClientTls(const std::string& ca_file) {
  auto context = std::make_unique<ssl::context>(ssl::context::tls_client);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_3_VERSION);
  boost::system::error_code error;
  if (ca_file.empty()) {
    context->set_default_verify_paths(error);
  } else {
    context->load_verify_file(ca_file, error);
  }
  if (error) throw Error(ca_file + ": no PEM certificate can be read from it (" + error.message() + ")");
  return context;
}

asio::awaitable<std::unique_ptr<Stream>> connectStream(const ServerAddress& address, ssl::context* tls,
                                                       std::chrono::nanoseconds patience) {
  const auto executor = co_await asio::this_coro::executor;
  tcp::resolver resolver(executor);
  auto [unknown, endpoints] = co_await resolver.async_resolve(address.host, std::to_string(address.port), kAwait);
  if (unknown) throw Error("the host " + address.host + " is not known: " + unknown.message());
  auto stream = std::make_unique<Stream>(Stream::Tcp(executor), tls);
  stream->tcp().expires_after(patience);
  auto [error, endpoint] = co_await stream->tcp().async_connect(endpoints, kAwait);
  if (error) throw Error(connectFailure(address, error));
  stream->tcp().socket().set_option(tcp::no_delay(true), error);
  stream->tcp().expires_after(patience);
  if (tls != nullptr) co_await shakeHands(*stream, address);
  stream->tcp().expires_never();
  co_return stream;
}

}  // namespace hl
