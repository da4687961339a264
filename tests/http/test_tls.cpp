// The server beyond loopback: TLS 1.3 with a certificate, a token, the cookie that pages get for it; and that it does
// not start without them.
#include "http/tls.h"

#include <gtest/gtest.h>

#include <boost/asio/read.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "base/error.h"
#include "fake_pages.h"
#include "fake_sessions.h"
#include "http/http_server.h"
#include "plain_client.h"
#include "test_certificate.h"

namespace hl::test_tls {
namespace {

using namespace test;
namespace ssl = boost::asio::ssl;
constexpr const char* kToken = "correct-horse-battery";

HttpServerSettings everywhere(const TlsFiles& tls) {
  HttpServerSettings settings;
  settings.port = 0;
  settings.listen = "0.0.0.0";
  settings.tls = tls;
  settings.token = kToken;
  return settings;
}

// A TLS connection of one version, which trusts the certificate in `trusted`.
class TlsClient {
 public:
  TlsClient(std::uint16_t port, const std::string& trusted, int version) : stream_(prepare(trusted, version), tls_) {
    stream_.set_verify_mode(ssl::verify_peer);
    stream_.next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
    stream_.handshake(ssl::stream_base::client);
    host_ = "127.0.0.1:" + std::to_string(port);
  }
  http::response<http::string_body> get(const std::string& target, const Headers& headers = {}) {
    http::request<http::string_body> message(http::verb::get, target, 11);
    message.set(http::field::host, host_);
    for (const auto& [field, value] : headers) message.set(field, value);
    http::write(stream_, message);
    http::response<http::string_body> response;
    http::read(stream_, buffer_, response);
    return response;
  }
  ssl::stream<tcp::socket>& stream() { return stream_; }
  const std::string& host() const { return host_; }

 private:
  boost::asio::io_context& prepare(const std::string& trusted, int version) {
    tls_.load_verify_file(trusted);
    SSL_CTX_set_min_proto_version(tls_.native_handle(), version);
    SSL_CTX_set_max_proto_version(tls_.native_handle(), version);
    return context_;
  }
  boost::asio::io_context context_;
  ssl::context tls_{ssl::context::tls_client};
  ssl::stream<tcp::socket> stream_;
  beast::flat_buffer buffer_;
  std::string host_;
};

// A WebSocket over a TLS connection; what the server answers when it declines.
websocket::response_type upgrade(TlsClient& client, websocket::stream<ssl::stream<tcp::socket>&>& socket,
                                 const std::string& target, const Headers& headers, beast::error_code& error) {
  socket.set_option(websocket::stream_base::decorator([headers](websocket::request_type& request) {
    for (const auto& [field, value] : headers) request.set(field, value);
  }));
  websocket::response_type response;
  socket.handshake(response, client.host(), target, error);
  return response;
}

void expectRefused(const HttpServerSettings& settings, const std::string& word) {
  try {
    HttpServer server(settings, test::fakePages());
    FAIL() << word;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(Tls, BeyondLoopbackTheServerInsistsOnTlsAndAToken) {
  const TlsFiles tls = makeCertificate("server");
  HttpServerSettings settings = everywhere(tls);
  settings.token.clear();
  expectRefused(settings, "token");
  settings = everywhere({});
  expectRefused(settings, "TLS");
  settings.listen = "::";
  expectRefused(settings, "TLS");
  settings = everywhere(tls);
  settings.token = "short";
  expectRefused(settings, "16");
  EXPECT_NO_THROW(HttpServer(everywhere(tls), test::fakePages()));
}

TEST(Tls, EveryLoopbackAddressWillDoAsItIs) {
  for (const char* address : {"127.0.0.1", "localhost", "127.0.0.2"}) {
    HttpServerSettings settings;
    settings.port = 0;
    settings.listen = address;
    EXPECT_NO_THROW(HttpServer(settings, test::fakePages())) << address;
  }
  HttpServerSettings settings;
  settings.listen = "my.server";
  expectRefused(settings, "my.server");
  settings.listen = "192.0.2.1";
  expectRefused(settings, "TLS");
}

TEST(Tls, FilesThatAreNoGoodAreNamed) {
  const TlsFiles one = makeCertificate("one");
  const TlsFiles two = makeCertificate("two");
  expectRefused(everywhere({"/nonexistent.crt", one.key}), "/nonexistent.crt");
  expectRefused(everywhere({one.certificate, "/nonexistent.key"}), "/nonexistent.key");
  expectRefused(everywhere({one.certificate, two.key}), two.key);
  expectRefused(everywhere({one.key, one.key}), one.key);
  expectRefused(everywhere({one.certificate, ""}), "both");
}

TEST(Tls, OnlyTls13IsSpoken) {
  const TlsFiles tls = makeCertificate("server");
  HttpServer server(everywhere(tls), test::fakePages());
  server.start();
  EXPECT_THROW(TlsClient(server.port(), tls.certificate, TLS1_2_VERSION), boost::system::system_error);
  TlsClient client(server.port(), tls.certificate, TLS1_3_VERSION);
  EXPECT_EQ(client.get("/healthz").result_int(), 200u);
  // Plain HTTP gets nothing.
  EXPECT_THROW(request(server.port(), "/healthz"), boost::system::system_error);
}

TEST(Tls, ThePageGetsACookieForTheTokenAndThenItsWebSocket) {
  const TlsFiles tls = makeCertificate("server");
  HttpServer server(everywhere(tls), test::fakePages());
  server.start();
  TlsClient client(server.port(), tls.certificate, TLS1_3_VERSION);
  EXPECT_EQ(client.get("/").result_int(), 401u);
  EXPECT_EQ(client.get("/?token=wrong-horse-battery").result_int(), 403u);
  const auto login = client.get(std::string("/?token=") + kToken);
  EXPECT_EQ(login.result_int(), 303u);
  EXPECT_EQ(login[http::field::location], "/");
  const std::string set_cookie(login[http::field::set_cookie]);
  EXPECT_NE(set_cookie.find("; Secure"), std::string::npos);
  const Headers own = {{http::field::cookie, set_cookie.substr(0, set_cookie.find(';'))},
                       {http::field::origin, "https://" + client.host()}};
  EXPECT_EQ(client.get("/", own).result_int(), 200u);
  EXPECT_EQ(client.get("/", {own[0], {http::field::origin, "https://evil.example"}}).result_int(), 403u);

  beast::error_code error;
  TlsClient stranger(server.port(), tls.certificate, TLS1_3_VERSION);
  websocket::stream<ssl::stream<tcp::socket>&> refused(stranger.stream());
  EXPECT_EQ(upgrade(stranger, refused, "/viewer", {own[1]}, error).result_int(), 401u);
  websocket::stream<ssl::stream<tcp::socket>&> page(client.stream());
  upgrade(client, page, "/viewer", own, error);
  ASSERT_FALSE(error) << error.message();
  for (const char* expected : {"hello", "scene", "state"}) {
    beast::flat_buffer buffer;
    page.read(buffer);
    EXPECT_EQ(beast::buffers_to_string(buffer.data()), expected);
  }
}

TEST(Tls, AnHlClientOpensWithTheTokenOrTheCookie) {
  const TlsFiles tls = makeCertificate("server");
  FakeHost host;
  HttpServer server(everywhere(tls), test::fakePages(), &host);
  server.start();
  TlsClient login(server.port(), tls.certificate, TLS1_3_VERSION);
  const std::string set_cookie(login.get(std::string("/?token=") + kToken)[http::field::set_cookie]);
  const Headers cookie = {{http::field::cookie, set_cookie.substr(0, set_cookie.find(';'))}};
  struct Case {
    Headers headers;
    std::string token;
    bool welcome;
  };
  for (const Case& c : {Case{{}, kToken, true}, Case{cookie, "", true}, Case{{}, "", false}}) {
    TlsClient client(server.port(), tls.certificate, TLS1_3_VERSION);
    websocket::stream<ssl::stream<tcp::socket>&> socket(client.stream());
    beast::error_code error;
    upgrade(client, socket, "/hl", c.headers, error);
    ASSERT_FALSE(error) << error.message();
    socket.binary(true);
    socket.write(boost::asio::buffer(openMessage(0, c.token).SerializeAsString()));
    beast::flat_buffer buffer;
    socket.read(buffer);
    proto::ServerReply reply;
    ASSERT_TRUE(reply.ParseFromString(beast::buffers_to_string(buffer.data())));
    EXPECT_EQ(reply.has_welcome(), c.welcome);
  }
  // Connections that were cut off, not closed, are ended all the same.
  host.waitForAlive(0);
}

TEST(Tls, ACertificateThatClientsRefuseTodayIsAWarning) {
  const auto warning = [](long days) {
    return certificateWarning(*makeServerTls(makeCertificate("dated", "IP:127.0.0.1", days)));
  };
  EXPECT_EQ(warning(0), "");
  EXPECT_NE(warning(-10).find("expired"), std::string::npos);
  EXPECT_NE(warning(10).find("not valid yet"), std::string::npos);
}

TEST(Tls, ASilentHandshakeHoldsNobodyUp) {
  const TlsFiles tls = makeCertificate("server");
  HttpServerSettings settings = everywhere(tls);
  settings.limits.handshake_s = 0.2;
  HttpServer server(settings, test::fakePages());
  server.start();
  boost::asio::io_context context;
  tcp::socket silent(context);
  silent.connect({boost::asio::ip::address_v4::loopback(), server.port()});
  TlsClient client(server.port(), tls.certificate, TLS1_3_VERSION);
  EXPECT_EQ(client.get("/healthz").result_int(), 200u);
  // The server hangs up on the silent one.
  char byte = 0;
  beast::error_code error;
  boost::asio::read(silent, boost::asio::buffer(&byte, 1), error);
  EXPECT_TRUE(error);
  const auto metrics = client.get("/metrics", {{http::field::authorization, std::string("Bearer ") + kToken}}).body();
  EXPECT_NE(metrics.find("hl_refused_total{reason=\"handshake\"} 1\n"), std::string::npos) << metrics;
}

}  // namespace
}  // namespace hl::test_tls
