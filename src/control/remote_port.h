// RemotePort: the hand's side of a teleoperation. The force of a robot far away is added to what the hand feels here,
// as far as that gives the hand no more energy than the robot's side has given up for it, and a small tank: whatever
// the line between them delays, loses or sends twice. docs/teleoperation.md has the equations, and where they come
// from.
//
// Energy is work of a held force along a way between two samples, so encoder steps to and fro add up to nothing.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "hl/hl_teleop.h"

namespace hl {

/// What has come from the robot, at the scale of the hand. Frame D.
struct RemoteInput {
  bool on = false;                  ///< there is a robot, or may come to be one
  bool engaged = false;             ///< the clutch holds
  std::int64_t fresh_until_ns = 0;  ///< on the clock of the servo; then the force fades
  Vec3 force_N = Vec3::Zero();      ///< on the hand
  double given_up_J = 0;            ///< a total that never goes down: what the robot's side has given up for the hand
};

/// Between steps. Owned by the servo.
struct RemotePort {
  HLteleopPort energy = hlTeleopPort();
  double part = 0;              ///< 0..1, of the robot's force
  Vec3 held_N = Vec3::Zero();   ///< what the last step added to the force on the hand
  double withheld_J = 0;        ///< work of the robot's force less that of what was added instead of it
  Vec3 asked_N = Vec3::Zero();  ///< the robot's force in the last step
};

/// So long after its deadline the force is zero, and so long it takes to come back.
inline constexpr double kRemoteFade_s = 0.025, kRemoteRise_s = 0.2;

/// What a step is to know.
struct RemoteStep {
  std::int64_t now_ns = 0;
  double period_s = 0;
  Vec3 way = Vec3::Zero();           ///< of the finger, since the step before
  Vec3 velocity_m_s = Vec3::Zero();  ///< filtered
  Vec3 local_N = Vec3::Zero();       ///< what the hand feels without the robot
};

/// What is to be added to `local_N`. Where both push the same way the larger counts: a wall that the scene has and the
/// robot touches is felt once. The caller says in `port.held_N` what was added in the end. RT-safe.
Vec3 remoteForce(RemotePort& port, const RemoteInput& input, const RemoteStep& step);

/// Without force nothing is held, and the robot's force comes back slowly. RT-safe.
void restRemote(RemotePort& port);

}  // namespace hl
