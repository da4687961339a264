// FakeServer: a server in the test's hands, at the other end of a Link of the scheme "fake:". It welcomes, notes what
// it is sent and, unless set otherwise, shows every frame immediately.
#pragma once

#include <gtest/gtest.h>
#include <hl.pb.h>
#include <hl/hl.h>

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/open_link.h"
#include "wire/link.h"

namespace hl::client {

struct FakeServer {
  bool answers_open = true;
  bool shows_frames = true;
  std::size_t queued_bytes = 0;  ///< what the link says
  std::string ended;             ///< why the link has ended
  proto::Welcome welcome;

  proto::Open open;
  std::vector<proto::ClientMessage> received;  ///< all but Open
  std::deque<proto::ServerReply> replies;

  FakeServer() {
    welcome.set_protocol_version(1);
    welcome.set_session(7);
    welcome.set_master(true);
    welcome.set_server_version("fake");
    welcome.mutable_limits()->set_message_bytes(4U << 20);
    welcome.mutable_limits()->set_state_rate_hz(1000);
    proto::DeviceInfo& device = *welcome.add_devices();
    device.set_name("fake hand");
    device.set_stiffness_n_m(1000);
    device.set_label("left");
    welcome.add_devices()->set_label("right");
  }

  void receive(proto::ClientMessage message) {
    if (message.has_open()) {
      open = message.open();
      if (answers_open) *replies.emplace_back().mutable_welcome() = welcome;
      return;
    }
    if (message.has_frame() && shows_frames) show(message.frame().number());
    received.push_back(std::move(message));
  }
  void show(std::uint64_t number) { replies.emplace_back().mutable_frame_shown()->set_number(number); }
  void refuse(std::uint64_t frame, const std::string& text) {
    proto::Refusal& refusal = *replies.emplace_back().mutable_refusal();
    refusal.set_frame(frame);
    refusal.set_text(text);
  }
  proto::ClientState& sendState() { return *replies.emplace_back().mutable_state(); }

  std::vector<proto::Frame> frames() const {
    std::vector<proto::Frame> all;
    for (const proto::ClientMessage& message : received)
      if (message.has_frame()) all.push_back(message.frame());
    return all;
  }
  /// The uploads, merged as the schema says.
  std::map<std::uint64_t, proto::Primitives> uploads() const {
    std::map<std::uint64_t, proto::Primitives> all;
    for (const proto::ClientMessage& message : received)
      for (const proto::Upload& upload : message.uploads().parts()) all[upload.id()].MergeFrom(upload.part());
    return all;
  }
};

class FakeLink : public Link {
 public:
  explicit FakeLink(std::shared_ptr<FakeServer> server) : server_(std::move(server)) {}
  void send(proto::ClientMessage message) override { server_->receive(std::move(message)); }
  std::size_t queuedBytes() const override { return server_->queued_bytes; }
  bool take(proto::ServerReply& reply) override {
    if (server_->replies.empty()) return false;
    reply = std::move(server_->replies.front());
    server_->replies.pop_front();
    return true;
  }
  bool wait(std::chrono::nanoseconds) override { return !server_->replies.empty(); }
  std::string ended() const override { return server_->ended; }

 private:
  std::shared_ptr<FakeServer> server_;
};

/// A current context that talks to a fake server. At its end no error may be left.
class CallsTest : public testing::Test {
 protected:
  CallsTest() {
    setLinkOpener("fake", [this](const ServerUrl&) { return std::make_unique<FakeLink>(server); });
    context = hlCreateContext("fake:?name=test");
    EXPECT_NE(context, nullptr) << hlGetConnectError();
    hlMakeCurrent(context);
  }
  ~CallsTest() override {
    EXPECT_EQ(hlGetError(), HL_NO_ERROR) << "left at the end: " << hlGetString(HL_ERROR_STRING);
    hlDestroyContext(context);
    setLinkOpener("fake", {});
  }

  /// Flushes and returns the frame that was sent; an empty one with number 0 when none was.
  proto::Frame flushed() {
    const std::size_t before = server->frames().size();
    hlFlush();
    const std::vector<proto::Frame> frames = server->frames();
    return frames.size() > before ? frames.back() : proto::Frame{};
  }

  std::shared_ptr<FakeServer> server = std::make_shared<FakeServer>();
  HLcontext* context = nullptr;
};

inline HLint integer(HLenum name) {
  HLint values[16] = {};
  hlGetIntegerv(name, values);
  return values[0];
}

inline HLdouble number(HLenum name) {
  HLdouble values[16] = {};
  hlGetDoublev(name, values);
  return values[0];
}

inline void triangle(double x = 0) {
  hlBegin(HL_TRIANGLES);
  hlVertex3d(x, 0, 0);
  hlVertex3d(x + 1, 0, 0);
  hlVertex3d(x, 1, 0);
  hlEnd();
}

template <typename Numbers>
std::vector<double> listOf(const Numbers& numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace hl::client
