// The client's link against a real server on loopback: everything arrives, states are the newest, and every end has a
// reason that helps.
#include "client/websocket_link.h"

#include <gtest/gtest.h>

#include <boost/asio/write.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "client/server_address.h"
#include "fake_pages.h"
#include "fake_sessions.h"
#include "http/http_server.h"
#include "plain_client.h"
#include "test_certificate.h"

namespace hl::test_websocket_link {
namespace {

using namespace test;
using namespace std::chrono_literals;

struct Served {
  explicit Served(HttpServerSettings settings = {}) : server(adjusted(std::move(settings)), test::fakePages(), &host) {
    server.start();
  }
  static HttpServerSettings adjusted(HttpServerSettings settings) {
    settings.port = 0;
    return settings;
  }
  std::string url(const std::string& scheme = "hl") const {
    return scheme + "://127.0.0.1:" + std::to_string(server.port());
  }
  FakeHost host;
  HttpServer server;
};

// The next reply, however long it takes; nothing when the link has ended.
std::optional<proto::ServerReply> next(Link& link) {
  while (!link.wait(1s)) {
    if (!link.ended().empty()) return {};
  }
  proto::ServerReply reply;
  link.take(reply);
  return reply;
}

std::unique_ptr<Link> connectTo(const std::string& url, const WebsocketLinkSettings& settings = {}) {
  return connectWebsocket(parseServerAddress(url), settings);
}

std::string whyNot(const std::string& url, const WebsocketLinkSettings& settings = {}) {
  try {
    connectTo(url, settings);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

proto::ClientMessage uploadOf(std::uint64_t id, int doubles) {
  proto::ClientMessage message;
  message.mutable_upload()->set_id(id);
  for (int i = 0; i < doubles; ++i) message.mutable_upload()->mutable_part()->add_vertices(i);
  return message;
}

TEST(ServerAddress, TakesWhatPeopleWrite) {
  EXPECT_EQ(parseServerAddress("hl://lab").text(), "lab:1997");
  EXPECT_EQ(parseServerAddress("hl://lab.example:80/").text(), "lab.example:80");
  EXPECT_EQ(parseServerAddress("hl://[::1]:2000").text(), "[::1]:2000");
  EXPECT_EQ(parseServerAddress("hl://[fe80::1]").host, "fe80::1");
  EXPECT_TRUE(parseServerAddress("hls://lab").tls);
  EXPECT_FALSE(parseServerAddress("hl://lab").tls);
  for (const char* bad : {"", "lab", "http://lab", "hl://", "hl://:1997", "hl://lab:", "hl://lab:0", "hl://lab:70000",
                          "hl://lab:1x", "hl://lab/path", "hl://a b", "hl://[::1", "hl://[::1]x:1", "hl://u@lab"}) {
    EXPECT_THROW(parseServerAddress(bad), Error) << bad;
  }
}

TEST(WebsocketLink, MessagesGoThereAndBack) {
  Served served;
  const auto link = connectTo(served.url());
  link->send(openMessage());
  for (std::uint64_t i = 1; i <= 100; ++i) link->send(frameMessage(i));
  EXPECT_TRUE(next(*link)->has_welcome());
  for (std::uint64_t i = 1; i <= 100; ++i) EXPECT_EQ(next(*link)->frame_shown().number(), i);
  EXPECT_EQ(link->ended(), "");
  EXPECT_FALSE(link->wait(0s));
}

TEST(WebsocketLink, ALargeMeshArrivesWhole) {
  Served served;
  const auto link = connectTo(served.url());
  link->send(openMessage());
  const proto::ClientMessage part = uploadOf(1, 250'000);
  constexpr std::size_t kParts = 32;  // 2 MB each
  for (std::size_t i = 0; i < kParts; ++i) link->send(part);
  EXPECT_GT(link->queuedBytes(), 0u);
  link->send(frameMessage(1));
  EXPECT_TRUE(next(*link)->has_welcome());
  EXPECT_EQ(next(*link)->frame_shown().number(), 1u);
  EXPECT_EQ(served.host.uploadBytes(), kParts * part.ByteSizeLong());
  EXPECT_EQ(link->queuedBytes(), 0u);
}

TEST(WebsocketLink, OfStatesThatWaitOnlyTheNewestIsKept) {
  Served served;
  const auto link = connectTo(served.url());
  link->send(openMessage(1000));
  served.host.waitUntil([](const auto& record) { return record.ever == 1 && record.states_taken[0] >= 50; });
  EXPECT_TRUE(next(*link)->has_welcome());
  int states = 0;
  link->send(frameMessage(1));
  while (!next(*link)->has_frame_shown()) ++states;
  // One that waited, and at most those that came while this thread was taking them one by one.
  EXPECT_LT(states, 50);
}

TEST(WebsocketLink, TheServersEndHasAReason) {
  Served served;
  const auto link = connectTo(served.url());
  link->send(openMessage());
  EXPECT_TRUE(next(*link)->has_welcome());
  served.host.endAll("the device has been unplugged");
  EXPECT_FALSE(next(*link));
  EXPECT_NE(link->ended().find("the device has been unplugged"), std::string::npos) << link->ended();
  link->send(frameMessage(1));
  EXPECT_EQ(link->queuedBytes(), 0u);
}

TEST(WebsocketLink, AServerThatStopsSaysSo) {
  Served served;
  const auto link = connectTo(served.url());
  link->send(openMessage());
  EXPECT_TRUE(next(*link)->has_welcome());
  served.server.stop();
  EXPECT_FALSE(next(*link));
  EXPECT_NE(link->ended().find("the server stops"), std::string::npos) << link->ended();
}

TEST(WebsocketLink, ARefusalIsAReplyAndThenTheEnd) {
  HttpServerSettings settings;
  settings.token = "correct-horse-battery";
  Served served(settings);
  const auto link = connectTo(served.url());
  link->send(openMessage(0, "wrong-horse-battery"));
  const auto reply = next(*link);
  ASSERT_TRUE(reply && reply->has_refusal());
  EXPECT_TRUE(reply->refusal().fatal());
  EXPECT_FALSE(next(*link));
  EXPECT_NE(link->ended().find("token"), std::string::npos) << link->ended();
}

TEST(WebsocketLink, WhatWasSentBeforeTheEndIsDelivered) {
  Served served;
  const proto::ClientMessage part = uploadOf(1, 250'000);
  {
    const auto link = connectTo(served.url());
    link->send(openMessage());
    for (int i = 0; i < 8; ++i) link->send(part);
    link->send(frameMessage(77));
  }
  served.host.waitUntil([](const auto& record) { return record.received.size() == 2; });
  EXPECT_EQ(served.host.received().back().frame().number(), 77u);
  EXPECT_EQ(served.host.uploadBytes(), 8 * part.ByteSizeLong());
  served.host.waitForAlive(0);
}

TEST(WebsocketLink, TooManyQueuedBytesEndIt) {
  Served served;
  WebsocketLinkSettings settings;
  settings.queue_bytes = 1'000'000;
  const auto link = connectTo(served.url(), settings);
  link->send(openMessage());
  link->send(uploadOf(1, 200'000));
  while (link->ended().empty()) link->wait(1ms);
  EXPECT_NE(link->ended().find("too many bytes"), std::string::npos) << link->ended();
}

TEST(WebsocketLink, APeerThatIsNoServerIsRecognised) {
  boost::asio::io_context context;
  tcp::acceptor acceptor(context, {boost::asio::ip::address_v4::loopback(), 0});
  const std::uint16_t port = acceptor.local_endpoint().port();
  const std::string url = "hl://127.0.0.1:" + std::to_string(port);
  std::thread stranger([&] {
    tcp::socket socket = acceptor.accept();
    boost::asio::write(socket, boost::asio::buffer(std::string("220 mail ready\r\n")));
  });
  EXPECT_NE(whyNot(url).find("does not answer as an HL server"), std::string::npos);
  stranger.join();
  WebsocketLinkSettings settings;
  settings.connect_s = 0.2;
  EXPECT_NE(whyNot(url, settings).find("does not answer"), std::string::npos);  // connects, and hears nothing
  acceptor.close();
  EXPECT_EQ(whyNot(url), "127.0.0.1:" + std::to_string(port) + " refused the connection; is hld running there?");
}

TEST(WebsocketLink, AServerWithoutClientsIsRecognised) {
  HttpServer server(Served::adjusted({}), test::fakePages());
  server.start();
  const std::string why = whyNot("hl://127.0.0.1:" + std::to_string(server.port()));
  EXPECT_NE(why.find("404"), std::string::npos) << why;
}

TEST(WebsocketLink, AnUnknownHostIsNamed) {
  EXPECT_NE(whyNot("hl://no-such-host.invalid").find("no-such-host.invalid"), std::string::npos);
}

TEST(WebsocketLink, WithTlsTheCertificateIsVerified) {
  HttpServerSettings settings;
  settings.tls = makeCertificate("server");
  Served served(settings);
  WebsocketLinkSettings trust;
  trust.ca_file = settings.tls.certificate;
  const auto link = connectTo(served.url("hls"), trust);
  link->send(openMessage());
  EXPECT_TRUE(next(*link)->has_welcome());

  EXPECT_NE(whyNot(served.url("hls")).find("not trusted"), std::string::npos);
  trust.ca_file = makeCertificate("other").certificate;
  EXPECT_NE(whyNot(served.url("hls"), trust).find("not trusted"), std::string::npos);
  trust.ca_file = "/nonexistent.crt";
  EXPECT_NE(whyNot(served.url("hls"), trust).find("/nonexistent.crt"), std::string::npos);
}

TEST(WebsocketLink, ACertificateForAnotherHostIsRefused) {
  HttpServerSettings settings;
  settings.tls = makeCertificate("elsewhere", "DNS:lab.example,IP:192.0.2.1");
  Served served(settings);
  WebsocketLinkSettings trust;
  trust.ca_file = settings.tls.certificate;
  const std::string why = whyNot(served.url("hls"), trust);
  EXPECT_NE(why.find("not trusted"), std::string::npos) << why;
  EXPECT_NE(why.find("mismatch"), std::string::npos) << why;
}

TEST(WebsocketLink, TheWrongSchemeIsRecognised) {
  Served plain;
  EXPECT_NE(whyNot(plain.url("hls")).find("hl://"), std::string::npos);
  HttpServerSettings settings;
  settings.tls = makeCertificate("server");
  Served encrypted(settings);
  EXPECT_NE(whyNot(encrypted.url("hl")).find("hls://"), std::string::npos);
}

}  // namespace
}  // namespace hl::test_websocket_link
