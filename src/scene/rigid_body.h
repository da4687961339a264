// Rigid body: an object of the scene that has a mass, and where it is now.
#pragma once

#include <memory>
#include <string>

#include "scene/body_poses.h"
#include "scene/body_spec.h"

namespace hl {

/// Shared by the snapshots that the body is in, one after the other.
struct RigidBody {
  std::string name;
  BodySpec spec;
  Pose start;                        ///< of its object frame
  std::shared_ptr<BodyPoses> poses;  ///< null: it is fixed
};

/// At `start`. `object`: bounds of its mesh; it never leaves `room`. Allocates.
std::shared_ptr<const RigidBody> makeRigidBody(std::string name, const BodySpec& spec, const Pose& start,
                                               const Box& object, const Box& room);

/// World frame: how far bodies may go from a scene of these bounds: as far again as it is large, to every side.
Box roomAround(const Box& bounds);

}  // namespace hl
