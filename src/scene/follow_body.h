// Follow body: the rigid body of a client's object, from that of the last snapshot.
#pragma once

#include <memory>
#include <string>

#include "scene/snapshot.h"

namespace hl {

/// What a client says of a body.
struct ClientBody {
  const BodySpec& spec;
  const Pose& start;
  const Box& object;  ///< bounds of its shape in its own frame
};

/// `before`: the same object in the last snapshot; null: it was not there. `scene`: bounds of all that the body may
/// meet. The same one where nothing about it has changed. Allocates.
std::shared_ptr<const RigidBody> followBody(const std::string& name, const ClientBody& now, const Instance* before,
                                            const Box& scene);

}  // namespace hl
