// LoopExchange: what the servo's loop, the proxy's loop, the hand's thread and whoever pulls the hand exchange. Each
// datum has one writer and one reader.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/latest.h"
#include "base/vec.h"
#include "control/hand_pull.h"
#include "control/remote_port.h"
#include "touch/held_contacts.h"

namespace hl {

/// What a tick came to, for the servo.
struct TickMessage {
  HeldContacts held;
  float work_us = 0;
};

/// Where a simulated hand has come. Frame D.
struct HandPlaces {
  Vec3 finger_D = Vec3::Zero();
  Vec3 proxy_D = Vec3::Zero();  ///< where there is none: the finger
};

/// Frame D.
struct LoopExchange {
  Latest<Vec3> finger_D{Vec3::Zero()};            ///< servo to proxy
  Latest<HandPlaces> hand{HandPlaces{}};          ///< servo to hand
  Latest<TickMessage> ticks{TickMessage{}};       ///< proxy to servo
  Latest<HandPull> pulls{HandPull{}};             ///< to the servo, from a program beside HL
  Latest<RemoteInput> remotes{RemoteInput{}};     ///< to the servo, from a robot far away
  Latest<RemotePort> remote_ports{RemotePort{}};  ///< from the servo, for the robot's side
  std::atomic<bool> makes_force{false};           ///< of the servo's last step; its watch clears it where it stalls
  /// Times that the device began to answer: the finger is elsewhere then.
  std::atomic<std::uint64_t> arrivals{0};
};

}  // namespace hl
