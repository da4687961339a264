// The server over real sockets on loopback: what it serves, whom it refuses, and that bad pages harm nobody else.
#include "http/http_server.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <string>
#include <utility>

#include "base/error.h"

namespace hl::test_http_server {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;

class HttpServerTest : public testing::Test {
 protected:
  HttpServerTest()
      : server_({0, "/nonexistent", 200},
                {[] { return std::string("hello"); }, [] { return sceneOnce(); }, [] { return std::string("state"); },
                 [this](PageNumber, const std::string& m) { received_ += m.size(); }, [this](PageNumber) { ++gone_; },
                 [](std::uint32_t owner) { return owner == kOwner ? recording() : nullptr; }}) {
    server_.start();
  }
  // Larger than what a socket takes at once.
  static std::string recordedBytes() {
    std::string bytes(3'000'000, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7 + i / 1000);
    return bytes;
  }
  static FilePointer recording() {
    FilePointer file = makePrivateFile();
    const std::string bytes = recordedBytes();
    EXPECT_EQ(::write(file->descriptor(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    ::lseek(file->descriptor(), 0, SEEK_SET);
    return file;
  }
  static SceneSource sceneOnce() {
    return [left = std::make_shared<const std::string>("scene")]() mutable { return std::exchange(left, nullptr); };
  }
  std::string host() const { return "127.0.0.1:" + std::to_string(server_.port()); }

  tcp::socket connect() {
    tcp::socket socket(context_);
    socket.connect({asio::ip::address_v4::loopback(), server_.port()});
    return socket;
  }
  unsigned statusOf(const std::string& target, const std::string& host_name, const std::string& origin = "",
                    http::verb verb = http::verb::get) {
    tcp::socket socket = connect();
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, host_name);
    if (!origin.empty()) request.set(http::field::origin, origin);
    http::write(socket, request);
    boost::beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response.result_int();
  }
  using Socket = websocket::stream<tcp::socket>;
  Socket open(const std::string& origin) {
    Socket page(connect());
    page.set_option(websocket::stream_base::decorator(
        [origin](websocket::request_type& request) { request.set(http::field::origin, origin); }));
    page.handshake(host(), "/viewer");
    page.binary(true);
    return page;
  }
  static std::string next(Socket& page) {
    boost::beast::flat_buffer buffer;
    page.read(buffer);
    return boost::beast::buffers_to_string(buffer.data());
  }

  static constexpr std::uint32_t kOwner = 4'000'000'000;
  asio::io_context context_;
  std::atomic<std::size_t> received_{0}, gone_{0};
  HttpServer server_;
};

TEST_F(HttpServerTest, AnswersItsOwnPageAndRefusesForeigners) {
  EXPECT_EQ(statusOf("/", host()), 200u);
  EXPECT_EQ(statusOf("/", host(), "http://" + host()), 200u);
  EXPECT_EQ(statusOf("/", host(), "http://evil.example"), 403u);
  EXPECT_EQ(statusOf("/", "evil.example"), 403u);
  EXPECT_EQ(statusOf("/../../etc/passwd", host()), 404u);
  EXPECT_EQ(statusOf("/", host(), "", http::verb::post), 405u);
}

TEST_F(HttpServerTest, SendsARecordingToItsPageAlone) {
  const std::string target = "/recording.hlr?owner=" + std::to_string(kOwner);
  tcp::socket socket = connect();
  for (int again = 0; again < 2; ++again) {  // the connection goes on
    http::request<http::empty_body> request(http::verb::get, target, 11);
    request.set(http::field::host, host());
    http::write(socket, request);
    boost::beast::flat_buffer buffer;
    http::response_parser<http::string_body> response;
    http::read(socket, buffer, response);
    EXPECT_EQ(response.get()[http::field::content_disposition], "attachment");
    EXPECT_TRUE(response.get().body() == recordedBytes());
  }
  EXPECT_EQ(statusOf("/recording.hlr?owner=1", host()), 404u);
  EXPECT_EQ(statusOf("/recording.hlr?owner=4000000000x", host()), 404u);
  EXPECT_EQ(statusOf("/recording.hlr", host()), 404u);
  EXPECT_EQ(statusOf(target, host(), "http://evil.example"), 403u);
  EXPECT_EQ(statusOf(target, "evil.example"), 403u);
  EXPECT_EQ(statusOf(target, host(), "", http::verb::post), 405u);
}

TEST_F(HttpServerTest, APageGetsHelloSceneThenStates) {
  Socket page = open("http://" + host());
  EXPECT_EQ(next(page), "hello");
  EXPECT_EQ(next(page), "scene");
  EXPECT_EQ(next(page), "state");
  page.write(asio::buffer(std::string("abc")));
  while (received_ < 3) EXPECT_EQ(next(page), "state");
}

TEST_F(HttpServerTest, AForeignOriginGetsNoWebSocket) {
  EXPECT_THROW(open("http://evil.example"), boost::system::system_error);
}

TEST_F(HttpServerTest, AMessageTooLargeEndsOnlyThatPage) {
  Socket good = open("http://" + host());
  Socket bad = open("http://" + host());
  bad.write(asio::buffer(std::string(Limits{}.page_message_bytes + 1, 'x')));
  EXPECT_THROW(for (int i = 0; i < 10'000; ++i) next(bad), boost::system::system_error);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(next(good).empty());
  EXPECT_EQ(received_, 0u);
}

TEST_F(HttpServerTest, AFloodEndsOnlyThatPage) {
  Socket good = open("http://" + host());
  Socket flood = open("http://" + host());
  try {
    for (int i = 0; i < 5000; ++i) flood.write(asio::buffer(std::string("f")));
  } catch (const boost::system::system_error&) {
  }
  EXPECT_THROW(for (int i = 0; i < 10'000; ++i) next(flood), boost::system::system_error);
  EXPECT_LE(received_, 2 * static_cast<std::size_t>(Limits{}.page_messages_Hz));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(next(good).empty());
}

TEST_F(HttpServerTest, GarbageAndHalfOpenConnectionsDoNotStopIt) {
  tcp::socket silent = connect();
  tcp::socket garbage = connect();
  asio::write(garbage, asio::buffer(std::string("\x16\x03\x01 not http at all\r\n\r\n")));
  EXPECT_EQ(statusOf("/", host()), 200u);
}

// The whole answer to these bytes, after which the server has closed the connection.
std::string answerTo(tcp::socket socket, const std::string& bytes) {
  boost::system::error_code error;
  asio::write(socket, asio::buffer(bytes), error);
  std::string answer;
  asio::read(socket, asio::dynamic_buffer(answer), error);
  return answer;
}

TEST_F(HttpServerTest, WhatIsNoRequestIsAnsweredAndCounted) {
  const std::string large(20'000, 'x');
  const std::pair<std::string, std::string> cases[] = {
      {"hello\r\n\r\n", "400 "},
      {"GET / HTTP/9.9\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nno colon\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nX: " + large + "\r\n\r\n", "431 "},
      {"GET / HTTP/1.1\r\nContent-Length: 20000\r\n\r\n" + large, "413 "}};
  for (const auto& [bytes, code] : cases)
    EXPECT_TRUE(answerTo(connect(), bytes).starts_with("HTTP/1.1 " + code)) << bytes.substr(0, 60);
  const std::string metrics =
      answerTo(connect(), "GET /metrics HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n");
  EXPECT_NE(metrics.find("hl_refused_total{reason=\"malformed\"} 4"), std::string::npos) << metrics;
  EXPECT_NE(metrics.find("hl_refused_total{reason=\"too_large\"} 2"), std::string::npos) << metrics;
}

TEST_F(HttpServerTest, APortInUseIsAClearError) {
  try {
    HttpServer second({server_.port(), "", 60}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--port"), std::string::npos);
  }
}

}  // namespace
}  // namespace hl::test_http_server
