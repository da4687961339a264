#include "session/stylus_messages.h"

#include <cmath>

namespace hl {

void toProto(const Stylus& stylus, bool has_wrist, proto::Stylus& out) {
  if (has_wrist) {
    toProto(stylus.turned, *out.mutable_rotation());
    toProto(stylus.spin_rad_s, *out.mutable_spin_rad_s());
  }
  out.set_gripper_rad(stylus.gripper_rad);
  out.set_gripper_n(stylus.gripper_N);
}

std::string faultOfTurn(const proto::HandTurn& turn) {
  Eigen::Quaterniond turned = turnOf(turn.rotation());
  if (turn.has_rotation() && !toUnit(turned)) return "hand_turn.rotation must hold finite numbers, not all of them 0";
  if (turn.has_gripper_rad() && !std::isfinite(turn.gripper_rad())) return "hand_turn.gripper_rad must be finite";
  return "";
}

void turnHand(const proto::HandTurn& turn, TouchSession& session) {
  if (turn.has_rotation()) session.hand().turn(turnOf(turn.rotation()));
  if (turn.has_gripper_rad()) session.hand().openGripper(turn.gripper_rad());
}

}  // namespace hl
