// Follow body: the rigid body of a client's object, from that of the last snapshot.
#pragma once

#include <memory>

#include "scene/editable_scene.h"

namespace hl {

/// `now.body` is there. `before`: the object in the last snapshot; null: none. `scene`: bounds of all that the body may
/// meet. The same one where nothing about it has changed. Allocates.
std::shared_ptr<const RigidBody> followBody(const PlacedShape& now, const Instance* before, const Box& scene);

}  // namespace hl
