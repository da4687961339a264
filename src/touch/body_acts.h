// Body acts: what the loop does to bodies between their steps: commands of clients, impulses over time, and what hands
// owe. The energy that it brings is booked as the client's or the hand's.
#pragma once

#include <memory>
#include <span>

#include "bodies/hand_node.h"
#include "bodies/world.h"
#include "scene/rigid_body.h"
#include "touch/body_command.h"

namespace hl {

/// The bodies of a world as they move.
struct MovingBodies {
  const World& world;
  WorldState& state;
  std::span<const std::shared_ptr<const RigidBody>> bodies;  ///< as World::bodies

  /// RT-safe.
  ShownBody shown(std::size_t i) const;
  /// Kinetic, and in the field of gravity. RT-safe.
  double energy_J(std::size_t i) const;
};

/// A command for what is not there does nothing; so is it with impulses. All RT-safe.
void act(const MovingBodies& moving, const BodyCommand& command, BodyPushes& pushes);
/// What `pushes` give in a step of this length. Those that end, or whose body has gone, are removed.
void push(const MovingBodies& moving, BodyPushes& pushes, double period_s);
void giveByHand(const MovingBodies& moving, const BodyImpulse& one);

}  // namespace hl
