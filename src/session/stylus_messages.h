// How the stylus of a device is turned, and how a simulated hand is to turn it, as messages of proto/hl.proto.
#pragma once

#include <hl.pb.h>

#include <string>

#include "device/device.h"
#include "io/vec_messages.h"
#include "touch/touch_session.h"

namespace hl {

void toProto(const Stylus& stylus, bool has_wrist, proto::Stylus& out);
/// In a message that has one, of a device with a wrist or a gripper.
template <typename Message>
void setStylus(const Stylus& stylus, const DeviceInfo& device, Message& out) {
  if (device.has_wrist || device.gripper_max_rad > 0) toProto(stylus, device.has_wrist, *out.mutable_stylus());
}

/// What of it cannot be, or empty.
std::string faultOfTurn(const proto::HandTurn& turn);
/// Requires that nothing of it is at fault.
void turnHand(const proto::HandTurn& turn, TouchSession& session);

}  // namespace hl
