#include "client/small_messages.h"

#include <hl/hl_types.h>

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "client/fault.h"
#include "session/limits.h"

namespace hl::client {

namespace {

// What the newer one says goes in the place of the older one: of merged vectors a 0 would leave the older number.
void putOver(proto::DeviceSettings& older, const proto::DeviceSettings& newer) {
  if (newer.has_workspace()) older.clear_workspace();
  if (newer.has_hand_goal()) older.clear_hand_goal();
  if (newer.hand_turn().has_rotation()) older.mutable_hand_turn()->clear_rotation();
  older.MergeFrom(newer);
}

}  // namespace

void SmallMessages::send(Link& link, proto::ClientMessage&& message) {
  if (message.has_body_command()) {
    if (commands_.commands_size() >= kMaxWaitingCommands)
      throw Fault(HL_BUSY, "too many commands to bodies wait to be sent; this one is not");
    *commands_.add_commands() = std::move(*message.mutable_body_command());
  } else {
    proto::ClientMessage& waiting = waiting_[message.body_case()];
    if (waiting.has_device()) {
      putOver(*waiting.mutable_device(), message.device());
    } else {
      waiting = std::move(message);
    }
  }
  sendWaiting(link);
}

void SmallMessages::sendWaiting(Link& link) {
  while (!empty() && rate_.allow(monotonicNow_ns())) {
    if (waiting_.empty()) {
      sendCommands(link);
    } else {
      link.send(std::move(waiting_.begin()->second));
      waiting_.erase(waiting_.begin());
    }
  }
}

void SmallMessages::sendCommands(Link& link) {
  proto::ClientMessage message;
  auto& commands = *commands_.mutable_commands();
  if (commands.size() == 1) {
    *message.mutable_body_command() = std::move(commands[0]);
    commands.Clear();
  } else {
    const int count = std::min(commands.size(), kMaxCommandsPerMessage);
    for (int i = 0; i < count; ++i) *message.mutable_body_commands()->add_commands() = std::move(commands[i]);
    commands.DeleteSubrange(0, count);
  }
  link.send(std::move(message));
}

}  // namespace hl::client
