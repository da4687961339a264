// BodiesMemory: what the steps of the bodies so far have left for the next one, so that they go on elsewhere to the
// bit: in a replay.
#pragma once

#include <cstdint>
#include <vector>

#include "base/fixed_vector.h"
#include "bodies/world.h"
#include "touch/body_command.h"
#include "touch/hand_account.h"

namespace hl {

/// Of one scene, between two ticks. Its lists have the room that reserve() made.
struct BodiesMemory {
  WorldState world;
  std::vector<Pose> poses;                            ///< of World::bodies, as the last tick saw them
  OwedImpulses owed;                                  ///< to bodies
  DrawnImpulses drawn;                                ///< the same, by fields
  FixedVector<HandContact, kContactsOfHand> held_by;  ///< what held the proxy
  BodyPushes pushes;                                  ///< of clients, that are given over time
  std::int64_t time_ns = 0;                           ///< of the last step
  bool begun = false;                                 ///< there was one

  /// For this many bodies and joints. Allocates.
  void reserve(std::size_t bodies, std::size_t joints) {
    world.bodies.reserve(bodies);
    world.joints.reserve(joints);
    world.asleep.reserve(mostRows(bodies));
    world.memory.reserve(mostRows(bodies));
    poses.reserve(bodies);
  }
  bool hasRoomFor(const World& of) const {
    return world.bodies.capacity() >= of.bodies.size() && world.joints.capacity() >= of.joints.size() &&
           poses.capacity() >= of.bodies.size() && world.memory.room() >= mostRows(of.bodies.size()) &&
           world.asleep.room() >= mostRows(of.bodies.size());
  }
};

}  // namespace hl
