// What goes to the server beside frames: no program can send so much of it that the server ends the conversation.
#include "client/small_messages.h"

#include <gtest/gtest.h>

#include "client/fake_server.h"
#include "session/limits.h"

namespace hl::client::test_small_messages {
namespace {

std::vector<proto::BodyCommand> commandsIn(const std::vector<proto::ClientMessage>& messages) {
  std::vector<proto::BodyCommand> all;
  for (const proto::ClientMessage& message : messages) {
    if (message.has_body_command()) all.push_back(message.body_command());
    EXPECT_LE(message.body_commands().commands_size(), kMaxCommandsPerMessage);
    for (const proto::BodyCommand& command : message.body_commands().commands()) all.push_back(command);
  }
  return all;
}

void defineBody(HLuint object) {
  hlNewObject(object);
  hlBodyd(HL_BODY_MASS, 0.1);
  triangle();
  hlEndObject();
}

// All in their order, in far fewer messages.
TEST_F(CallsTest, ManyCommandsToBodiesGoTogether) {
  defineBody(2);
  hlFlush();
  const std::size_t before = server->received.size();
  for (int i = 0; i < 4000; ++i) hlBodyImpulsed(2, 1e-3 * i, 0, 0, 0, 0, 0, 0);
  hlFinish();
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  const auto commands = commandsIn(server->received);
  ASSERT_EQ(commands.size(), 4000U);
  for (std::size_t i = 0; i < commands.size(); ++i)
    ASSERT_EQ(commands[i].push().impulse_n_s().x(), 1e-3 * static_cast<double>(i));
  EXPECT_LT(server->received.size() - before, 1.2 * kSmallMessages_Hz);
}

TEST_F(CallsTest, MoreCommandsThanMayWaitAreRefused) {
  defineBody(2);
  hlFlush();
  HLenum error = HL_NO_ERROR;
  for (int i = 0; i < 100000 && error == HL_NO_ERROR; ++i) {
    hlBodyVelocityd(2, 1, 0, 0, 0, 0, 0);
    error = hlGetError();
  }
  EXPECT_EQ(error, HL_BUSY);
  hlFinish();
  hlBodyVelocityd(2, 1, 0, 0, 0, 0, 0);
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
}

// Of settings the newest, each part for itself.
TEST_F(CallsTest, ManySettingsGoAsTheNewest) {
  for (int i = 1; i <= 20000; ++i) {
    hlProxyd(HL_PROXY_RADIUS, 1e-6 * i);
    hlHandGoal3d(20000 - i, 0, 1);
    if (i == 15000) hlSpringd(500);
  }
  hlStateRate(17);
  hlFinish();
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  EXPECT_LT(server->received.size(), 1.2 * kSmallMessages_Hz);
  proto::DeviceSettings last;
  double spring = 0, rate = 0;
  for (const proto::ClientMessage& message : server->received) {
    if (message.device().has_proxy_radius()) last.set_proxy_radius(message.device().proxy_radius());
    if (message.device().has_hand_goal()) *last.mutable_hand_goal() = message.device().hand_goal();
    if (message.device().has_stiffness_n_m()) spring = message.device().stiffness_n_m();
    if (message.has_state_rate()) rate = message.state_rate().rate_hz();
  }
  EXPECT_NEAR(last.proxy_radius(), 0.02, 1e-12);
  EXPECT_EQ(last.hand_goal().position().x(), 0);
  EXPECT_EQ(last.hand_goal().position().z(), 1);
  EXPECT_EQ(spring, 500);
  EXPECT_EQ(rate, 17);
}

// It is reported once: after what was kept before.
TEST_F(CallsTest, TheEndOfTheConversationWaitsBehindAnotherError) {
  hlEnd();
  server->ended = "the line was cut";
  hlFlush();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
  EXPECT_EQ(hlGetError(), HL_CONNECTION_LOST);
  EXPECT_STREQ(hlGetString(HL_ERROR_STRING), "the conversation has ended: the line was cut");
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
}

}  // namespace
}  // namespace hl::client::test_small_messages
