// A client's session with rigid bodies on a running server, without a network.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "session/touch_server.h"
#include "take_replies.h"

namespace hl::test {

inline constexpr double kHalf_m = 0.02;

inline TouchServerSettings settingsOf() {
  TouchServerSettings settings;
  settings.touch.explore = false;
  settings.touch.world_per_device = 1;
  return settings;
}

inline void addBox(proto::Primitives& out, const Vec3& half) {
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) out.add_vertices((i >> axis & 1) != 0 ? half[axis] : -half[axis]);
  }
  for (const std::uint32_t i : {0U, 2U, 3U, 0U, 3U, 1U, 4U, 5U, 7U, 4U, 7U, 6U, 0U, 1U, 5U, 0U, 5U, 4U,
                                2U, 6U, 7U, 2U, 7U, 3U, 0U, 4U, 6U, 0U, 6U, 2U, 1U, 3U, 7U, 1U, 7U, 5U})
    out.add_triangles(i);
}

inline void addMatrix(proto::Item& item, const Vec3& origin, double scale = 1) {
  for (const double v :
       {scale, 0., 0., 0., 0., scale, 0., 0., 0., 0., scale, 0., origin.x(), origin.y(), origin.z(), 1.})
    item.add_matrix(v);
}

// Object 1: a floor of 2 m whose top is at y = 0. Object 2: a block of 100 g, a body. The hand is near the origin.
inline proto::Frame blocksFrame(std::uint64_t number, const std::vector<Vec3>& blocks) {
  proto::Frame frame;
  frame.set_number(number);
  proto::ObjectDefinition& floor = *frame.add_objects();
  floor.set_id(1);
  addBox(*floor.add_items()->mutable_primitives(), Vec3(1, 0.05, 1));
  proto::ObjectDefinition& block = *frame.add_objects();
  block.set_id(2);
  addBox(*block.add_items()->mutable_primitives(), Vec3::Constant(kHalf_m));
  block.mutable_body()->set_mass_kg(0.1);
  block.mutable_body()->set_shape(proto::BOX);
  proto::Item& ground = *frame.mutable_world()->add_items();
  ground.set_call(1);
  addMatrix(ground, Vec3(0, -0.05, 0));
  std::uint32_t name = 10;
  for (const Vec3& place : blocks) {
    proto::Item& call = *frame.mutable_world()->add_items();
    call.set_call(2);
    call.set_name(++name);
    addMatrix(call, place);
  }
  return frame;
}

inline void set(proto::Vec3& out, const Vec3& v) {
  out.set_x(v.x());
  out.set_y(v.y());
  out.set_z(v.z());
}
inline Vec3 vecOf(const proto::Vec3& v) { return {v.x(), v.y(), v.z()}; }

class BodiesClient {
 public:
  explicit BodiesClient(TouchServer& server) : session_(server.connect([] {})) {
    proto::ClientMessage message;
    message.mutable_open()->set_protocol_version(1);
    message.mutable_open()->set_master(true);
    message.mutable_open()->set_state_rate_hz(1000);
    session_->receive(message);
    proto::ClientMessage request;
    request.mutable_body_request()->set_wanted(true);
    session_->receive(request);
  }

  /// What it was refused for; "" when it is shown.
  std::string show(const proto::Frame& frame) {
    proto::ClientMessage message;
    *message.mutable_frame() = frame;
    refusal_.clear();
    session_->receive(message);
    EXPECT_TRUE(until([&] { return shown_ == frame.number() || !refusal_.empty(); }));
    return refusal_;
  }
  std::string act(const proto::BodyCommand& command) {
    proto::ClientMessage message;
    *message.mutable_body_command() = command;
    return answerTo(message);
  }
  std::string hear(double impacts_above_N_s) {
    proto::ClientMessage message;
    message.mutable_body_request()->set_wanted(true);
    message.mutable_body_request()->set_events(true);
    message.mutable_body_request()->set_impacts_above_n_s(impacts_above_N_s);
    return answerTo(message);
  }
  /// What a message was refused for at once; "": it was not.
  std::string answerTo(const proto::ClientMessage& message) {
    refusal_.clear();
    session_->receive(message);
    proto::ServerReply reply;
    while (session_->take(reply)) remember(reply);
    return refusal_;
  }
  bool until(const std::function<bool()>& reached) {
    return takeUntil(
        *session_, [this](const proto::ServerReply& reply) { remember(reply); }, reached);
  }
  /// Until so many bodies are reported that this holds for the first.
  bool untilBody(const std::function<bool(const proto::BodyState&)>& holds) {
    return until([&] { return state_.bodies_size() > 0 && holds(state_.bodies(0)); });
  }
  void remember(const proto::ServerReply& reply) {
    if (reply.has_state()) state_ = reply.state();
    if (reply.has_frame_shown()) {
      shown_ = reply.frame_shown().number();
      warnings_.assign(reply.frame_shown().warnings().begin(), reply.frame_shown().warnings().end());
    }
    if (reply.has_refusal()) refusal_ = reply.refusal().text();
    if (reply.has_event()) events_.push_back(reply.event());
  }

  std::unique_ptr<ClientSession> session_;
  proto::ClientState state_;
  std::string refusal_;
  std::vector<proto::Event> events_;
  std::vector<std::string> warnings_;  // of the last frame that was shown
  std::uint64_t shown_ = 0;
};

}  // namespace hl::test
