// HL clients over real sockets on loopback: what they say arrives, in both forms, and a client that misbehaves in any
// way is ended with a reason while another one goes on as if nothing had happened.
#include "fake_pages.h"
#include "http/websocket_session.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "fake_sessions.h"
#include "http/http_server.h"
#include "plain_client.h"

namespace hl::test_websocket_session {
namespace {

using test::FakeHost;
using test::frameMessage;
using test::openMessage;
using test::PlainClient;
using close = boost::beast::websocket::close_code;

struct Served {
  explicit Served(HttpServerSettings settings = {}, std::size_t state_bytes = 100, int most = 1'000'000)
      : host(state_bytes, most), server(adjusted(std::move(settings)), test::fakePages(), &host) {
    server.start();
  }
  static HttpServerSettings adjusted(HttpServerSettings settings) {
    settings.port = 0;
    return settings;
  }
  std::uint16_t port() const { return server.port(); }

  FakeHost host;  // outlives the server
  HttpServer server;
};

HttpServerSettings withLimits(const Limits& limits) {
  HttpServerSettings settings;
  settings.limits = limits;
  return settings;
}

// A client that has been welcomed.
struct Welcomed : PlainClient {
  explicit Welcomed(const Served& served, double state_rate_Hz = 0) : PlainClient(served.port()) {
    send(openMessage(state_rate_Hz));
    EXPECT_TRUE(nextAnswer()->has_welcome());
  }
};

TEST(WebSocketSession, AnswersInBinaryToBinary) {
  Served served;
  Welcomed client(served);
  EXPECT_FALSE(client.gotText());
  EXPECT_TRUE(client.isServed(7));
}

TEST(WebSocketSession, AnswersInJsonToJson) {
  Served served;
  PlainClient client(served.port());
  client.sendText(R"({"open": {"protocol_version": 1, "state_rate_Hz": 100}})");
  EXPECT_TRUE(client.next()->has_welcome());
  EXPECT_TRUE(client.gotText());
  const auto state = client.next();
  ASSERT_TRUE(state && state->has_state());
  // The schema's own names, and zeros are there to be read.
  EXPECT_NE(client.text().find("\"time_s\":"), std::string::npos) << client.text();
  EXPECT_NE(client.text().find("\"proxy_radius\":0"), std::string::npos) << client.text();
}

TEST(WebSocketSession, AFrameInEitherFormIsTheSameMessage) {
  Served served;
  Welcomed client(served);
  proto::ClientMessage message = frameMessage(5);
  proto::ObjectDefinition& object = *message.mutable_frame()->add_objects();
  object.set_id(3);
  proto::Item& item = *object.add_items();
  for (const double x : {0.0, 0.1, -1e-300, 1.0 / 3, 1e300}) item.mutable_primitives()->add_vertices(x);
  for (const unsigned i : {0U, 1U, 4'000'000'000U}) item.mutable_primitives()->add_triangles(i);
  item.mutable_material()->set_stiffness(0);
  item.set_name(0);
  message.mutable_frame()->mutable_world()->add_items()->set_call(3);
  client.send(message);
  client.sendJson(message);
  served.host.waitUntil([](const auto& record) { return record.received.size() == 3; });
  const auto received = served.host.received();
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(received[1], message));
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(received[2], message));
  // Replies stay in the form of the first message.
  EXPECT_TRUE(client.nextAnswer()->has_frame_shown());
  EXPECT_TRUE(client.nextAnswer()->has_frame_shown());
  EXPECT_FALSE(client.gotText());
}

TEST(WebSocketSession, AnEventComesWithoutWaitingForAnything) {
  Served served;
  Welcomed client(served);
  for (int i = 0; i < 20; ++i) {
    served.host.pushEvent();
    EXPECT_TRUE(client.next()->has_event());
  }
}

TEST(WebSocketSession, GarbageEndsItsSessionWithAReason) {
  Served served;
  Welcomed good(served);
  for (const bool text : {false, true}) {
    Welcomed bad(served);
    if (text) {
      bad.sendText(R"({"frame": {"numbre": 1}})");
    } else {
      bad.sendBinary("\xff\xff\xff not protobuf");
    }
    EXPECT_NE(bad.readToEnd().find("ClientMessage"), std::string::npos);
    EXPECT_EQ(bad.closeCode(), close::bad_payload);
    EXPECT_NE(bad.closeReason().find("ClientMessage"), std::string::npos);
  }
  served.host.waitForAlive(1);
  EXPECT_TRUE(good.isServed(1));
}

// A client that sends many frames ahead knows which one has the mistake.
TEST(WebSocketSession, AFrameThatIsNoMessageIsRefusedByItsNumber) {
  Served served;
  const auto refusedFrame = [&](const std::string& text) {
    Welcomed client(served);
    client.sendText(text);
    std::uint64_t frame = 0;
    while (const auto reply = client.next()) {
      if (reply->refusal().fatal()) frame = reply->refusal().frame();
    }
    return frame;
  };
  EXPECT_EQ(refusedFrame(R"({"frame": {"number": 7, "worlds": {}}})"), 7U);
  EXPECT_EQ(refusedFrame(R"({"frame": {"number": "18446744073709551615", "interval_s": "x"}})"), UINT64_MAX);
  EXPECT_EQ(refusedFrame(R"({"frame": {"number": -7}})"), 0U);
  EXPECT_EQ(refusedFrame(R"({"frame": [7]})"), 0U);
  EXPECT_EQ(refusedFrame(R"({"call": 9})"), 0U);
  EXPECT_EQ(refusedFrame(R"({"frame": {"number": 7)"), 0U) << "it is no JSON";
}

TEST(WebSocketSession, AnEmptyMessageAndTextThatIsNoTextAreGarbageToo) {
  Served served;
  Welcomed empty(served);
  empty.sendBinary("");
  EXPECT_NE(empty.readToEnd().find("empty"), std::string::npos);
  Welcomed broken(served);
  broken.sendText("\xc3\x28");
  broken.readToEnd();
  EXPECT_EQ(broken.closeCode(), close::bad_payload);
  served.host.waitForAlive(0);
}

TEST(MessageForms, BytesOfAnyKindAreDecodedOrRefusedInOneLine) {
  std::mt19937 random(1);
  const std::string good = openMessage(60, "token").SerializeAsString() + frameMessage(3).SerializeAsString();
  const std::string good_json = R"({"frame": {"number": 3, "world": {"items": [{"matrix": [1, 0, 0]}]}}})";
  for (int i = 0; i < 20'000; ++i) {
    const MessageForm form = i % 2 == 0 ? MessageForm::kBinary : MessageForm::kJson;
    std::string bytes = form == MessageForm::kBinary ? good : good_json;
    bytes.resize(random() % (bytes.size() + 1));
    for (unsigned changes = random() % 4; changes > 0 && !bytes.empty(); --changes) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    proto::ClientMessage message;
    const std::string fault = decodeMessage(form, bytes, message);
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    EXPECT_LT(fault.size(), 400u);
    if (!fault.empty()) continue;
    EXPECT_NE(message.body_case(), proto::ClientMessage::BODY_NOT_SET);
  }
}

TEST(WebSocketSession, NothingComesBeforeOpen) {
  Served served;
  PlainClient client(served.port());
  client.send(frameMessage(1));
  EXPECT_EQ(client.readToEnd(), "the first message must be open");
  EXPECT_EQ(client.closeCode(), close::policy_error);
  EXPECT_EQ(served.host.ever(), 0);
}

TEST(WebSocketSession, AMessageTooLargeEndsItsSessionWithAReason) {
  Limits limits;
  limits.message_bytes = 100'000;
  Served served(withLimits(limits));
  Welcomed good(served);
  Welcomed bad(served);
  proto::ClientMessage message = frameMessage(1);
  message.mutable_frame()->add_deleted_textures(std::string(90'000, 'x'));
  bad.send(message);
  EXPECT_TRUE(bad.nextAnswer()->has_frame_shown());
  message.mutable_frame()->add_deleted_textures(std::string(10'000, 'x'));
  bad.send(message);
  EXPECT_NE(bad.readToEnd().find("100000 bytes"), std::string::npos);
  EXPECT_EQ(bad.closeCode(), close::too_big);
  EXPECT_TRUE(good.isServed(1));
}

TEST(WebSocketSession, AStrangerMaySendLittle) {
  Served served;
  PlainClient client(served.port());
  proto::ClientMessage message = openMessage();
  message.mutable_open()->set_client_name(std::string(Limits{}.open_bytes, 'x'));
  client.send(message);
  EXPECT_FALSE(client.readToEnd().empty());
  EXPECT_EQ(client.closeCode(), close::too_big);
  EXPECT_EQ(served.host.ever(), 0);
}

TEST(WebSocketSession, AFloodEndsItsSession) {
  Limits limits;
  limits.messages_Hz = 100;
  Served served(withLimits(limits));
  Welcomed good(served);
  Welcomed flood(served);
  for (std::uint64_t i = 0; i < 1000; ++i) flood.send(frameMessage(i));
  EXPECT_NE(flood.readToEnd().find("too many messages"), std::string::npos);
  EXPECT_EQ(flood.closeCode(), close::policy_error);
  EXPECT_LT(served.host.received().size(), 900u);
  served.host.waitForAlive(1);
  EXPECT_TRUE(good.isServed(1));
}

TEST(WebSocketSession, SilenceInsteadOfOpenIsEnded) {
  Limits limits;
  limits.handshake_s = 0.3;
  Served served(withLimits(limits));
  PlainClient silent(served.port());
  EXPECT_EQ(silent.readToEnd(), "no Open came in time; send it first");
  EXPECT_EQ(silent.closeCode(), close::policy_error);
  EXPECT_EQ(served.host.ever(), 0);
}

// One that is more than light work.
proto::ClientMessage largeFrame(std::uint64_t number) {
  constexpr int kNumbers = 30'000;
  proto::ClientMessage message = frameMessage(number);
  proto::Primitives& mesh = *message.mutable_frame()->add_objects()->add_items()->mutable_primitives();
  for (int i = 0; i < kNumbers; ++i) mesh.add_vertices(i);
  return message;
}

// As many as there are workers for them, and one more that waits for one.
TEST(WebSocketSession, LargeMessagesThatTakeLongDelayNeitherStatesNorSmallMessagesOfOthers) {
  Served served;
  const int workers = static_cast<int>(Limits{}.workers);
  std::vector<std::unique_ptr<Welcomed>> busy;
  for (int i = 0; i <= workers; ++i) busy.push_back(std::make_unique<Welcomed>(served));
  Welcomed other(served, 1000);
  served.host.holdFrames(true);
  for (const auto& client : busy) client->send(largeFrame(1));
  served.host.waitForHeld(workers);
  for (std::uint64_t number = 1; number <= 100; ++number) {
    ASSERT_TRUE(other.next()->has_state());
    ASSERT_TRUE(other.isServed(number));
  }
  Welcomed late(served);
  ASSERT_TRUE(late.isServed(1)) << "who comes meanwhile is welcome";
  EXPECT_EQ(test::request(served.port(), "/healthz").result_int(), 200u);
  served.host.holdFrames(false);
  for (const auto& client : busy) EXPECT_EQ(client->nextAnswer()->frame_shown().number(), 1u);
}

TEST(WebSocketSession, ASlowReaderMissesStatesAndNothingElse) {
  constexpr std::size_t kState_bytes = 200'000;
  Served served({}, kState_bytes);
  PlainClient slow(served.port(), {}, "/hl", 16 * 1024);
  slow.send(openMessage(1000));
  served.host.waitForAlive(1);
  Welcomed quick(served, 1000);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(quick.next()->has_state());
  // What the kernel holds is all that was taken for the slow one.
  EXPECT_LT(served.host.statesTaken(0), 100);
  // It reads again: its Welcome, states in order, and then an answer.
  slow.send(frameMessage(9));
  EXPECT_TRUE(slow.next()->has_welcome());
  double last = 0;
  while (const auto reply = slow.next()) {
    if (!reply->has_state()) {
      EXPECT_EQ(reply->frame_shown().number(), 9u);
      break;
    }
    EXPECT_GT(reply->state().time_s(), last);
    last = reply->state().time_s();
  }
}

TEST(WebSocketSession, AReaderThatStallsForGoodIsEnded) {
  Limits limits;
  limits.write_s = 0.5;
  Served served(withLimits(limits), 200'000);
  PlainClient stalled(served.port(), {}, "/hl", 16 * 1024);
  stalled.send(openMessage(1000));
  served.host.waitUntil([](const auto& record) { return record.ever == 1; });
  served.host.waitForAlive(0);
  Welcomed other(served);
  EXPECT_TRUE(other.isServed(1));
}

TEST(WebSocketSession, AHalfOpenConnectionIsEnded) {
  Limits limits;
  limits.idle_s = 0.3;
  Served served(withLimits(limits));
  PlainClient absent(served.port());
  absent.send(openMessage());
  served.host.waitUntil([](const auto& record) { return record.ever == 1; });
  // It answers no pings, for it never reads.
  served.host.waitForAlive(0);
}

TEST(WebSocketSession, AClientThatOnlyListensIsKept) {
  Limits limits;
  limits.idle_s = 1;  // a busy machine may keep the client from reading for a part of it
  Served served(withLimits(limits));
  Welcomed listener(served, 100);
  // Three times as long as silence is borne: pings are answered while it reads.
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(listener.next()->has_state());
  EXPECT_EQ(served.host.alive(), 1);
}

TEST(WebSocketSession, WithoutRoomAClientIsRefusedWithTheReason) {
  Served served({}, 100, 1);
  Welcomed first(served);
  PlainClient second(served.port());
  second.send(openMessage());
  EXPECT_EQ(second.readToEnd(), "no room for another session");
  EXPECT_EQ(second.closeCode(), close::try_again_later);
  EXPECT_TRUE(first.isServed(1));
}

TEST(WebSocketSession, TheTokenIsAskedForAndGoesNoFurther) {
  HttpServerSettings settings;
  settings.token = "correct-horse-battery";
  Served served(settings);
  for (const char* wrong : {"", "correct-horse-batterx", "correct-horse-battery-staple"}) {
    PlainClient client(served.port());
    client.send(openMessage(0, wrong));
    EXPECT_NE(client.readToEnd().find("token"), std::string::npos);
    EXPECT_EQ(client.closeCode(), close::policy_error);
  }
  EXPECT_EQ(served.host.ever(), 0);
  PlainClient client(served.port());
  client.send(openMessage(0, settings.token));
  EXPECT_TRUE(client.next()->has_welcome());
  EXPECT_EQ(served.host.received().front().open().token(), "");
}

TEST(WebSocketSession, ANewTokenCountsForNewSessions) {
  HttpServerSettings settings;
  settings.token = "correct-horse-battery";
  Served served(settings);
  PlainClient old(served.port());
  old.send(openMessage(0, settings.token));
  EXPECT_TRUE(old.next()->has_welcome());
  served.server.setToken("another-horse-battery");
  EXPECT_TRUE(old.isServed(1));
  PlainClient late(served.port());
  late.send(openMessage(0, settings.token));
  EXPECT_FALSE(late.readToEnd().empty());
  PlainClient fresh(served.port());
  fresh.send(openMessage(0, "another-horse-battery"));
  EXPECT_TRUE(fresh.next()->has_welcome());
}

TEST(WebSocketSession, OnlyProgramsAndTheOwnPageMayConnect) {
  Served served;
  const std::string own = "http://127.0.0.1:" + std::to_string(served.port());
  PlainClient page(served.port(), {{boost::beast::http::field::origin, own}});
  page.send(openMessage());
  EXPECT_TRUE(page.next()->has_welcome());
  EXPECT_THROW(PlainClient(served.port(), {{boost::beast::http::field::origin, "http://evil.example"}}),
               boost::system::system_error);
  EXPECT_THROW(PlainClient(served.port(), {{boost::beast::http::field::host, "evil.example"}}),
               boost::system::system_error);
}

TEST(WebSocketSession, AnAddressOfSocketsSaysSoToOtherRequests) {
  Served served;
  EXPECT_EQ(test::request(served.port(), "/hl").result_int(), 426u);
}

TEST(WebSocketSession, AnOpenThatTheSessionRefusesIsAnsweredAsOne) {
  Served served;
  served.host.endAll("there is no device 3");
  PlainClient client(served.port());
  client.send(openMessage());
  EXPECT_EQ(client.readToEnd(), "there is no device 3");
  EXPECT_EQ(client.closeReason(), "there is no device 3");
}

TEST(WebSocketSession, AnOpenTooLargeIsRefusedInItsOwnForm) {
  Served served;
  PlainClient client(served.port());
  proto::ClientMessage message = openMessage();
  message.mutable_open()->set_client_name(std::string(Limits{}.open_bytes, 'x'));
  client.sendJson(message);
  EXPECT_FALSE(client.readToEnd().empty());
  EXPECT_TRUE(client.gotText());
}

TEST(WebSocketSession, WithoutASessionHostThereIsNoSuchPlace) {
  HttpServer server(Served::adjusted({}), test::fakePages());
  server.start();
  EXPECT_EQ(test::request(server.port(), "/hl").result_int(), 404u);
  EXPECT_THROW(PlainClient client(server.port()), boost::system::system_error);
}

TEST(WebSocketSession, TheSessionsOwnEndReachesTheClient) {
  Served served;
  Welcomed client(served);
  served.host.endAll("the device has been unplugged");
  EXPECT_EQ(client.readToEnd(), "");
  EXPECT_EQ(client.closeReason(), "the device has been unplugged");
  served.host.waitForAlive(0);
}

TEST(WebSocketSession, AServerThatStopsSaysGoodbye) {
  Served served;
  Welcomed client(served, 1000);
  Welcomed deaf(served, 1000);
  std::thread reader([&client] { client.readToEnd(); });
  served.server.stop();
  EXPECT_EQ(served.host.alive(), 0);
  reader.join();
  EXPECT_EQ(client.closeCode(), close::going_away);
}

std::size_t openDescriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0;
  double resident = 0;
  file >> total >> resident;
  return resident * 4096e-6;
}

// A third says goodbye, a third just goes, a third is gone before it has said anything.
void comeAndGo(Served& served, int times) {
  for (int i = 0; i < times; ++i) {
    PlainClient client(served.port());
    if (i % 3 == 0) continue;
    client.send(openMessage(500));
    EXPECT_TRUE(client.nextAnswer()->has_welcome());
    if (i % 3 == 1) client.stream().close(boost::beast::websocket::close_code::normal);
  }
}

TEST(WebSocketSession, AThousandClientsLeaveNothingBehind) {
  Served served;
  const std::size_t descriptors = openDescriptors();
  comeAndGo(served, 200);
  served.host.waitForAlive(0);
  const double before_MB = residentMegabytes();
  comeAndGo(served, 1000);
  served.host.waitForAlive(0);
  while (openDescriptors() > descriptors) std::this_thread::yield();
#ifndef HL_SANITIZED
  EXPECT_LT(residentMegabytes() - before_MB, 8);
#else
  (void)before_MB;  // the sanitizers keep what is freed
#endif
}

}  // namespace
}  // namespace hl::test_websocket_session
