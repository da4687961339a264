// Rigid bodies in messages, for recordings and for the process that reads foreign files. What comes back is the same to
// the bit, or is refused.
#pragma once

#include <recording.pb.h>

#include <memory>

#include "scene/scene_model.h"

namespace hl {

/// All but the identity.
void toProto(const RigidBody& body, proto::RecordedBody& out);
/// All but the model.
void toProto(const SceneBody& body, proto::RecordedBody& out);
/// At its start. Throws hl::Error, as what follows.
std::shared_ptr<const RigidBody> rigidBodyOf(const proto::RecordedBody& in);
SceneBody sceneBodyOf(const proto::RecordedBody& in);
void toProto(const Mechanics& mechanics, proto::RecordedMechanics& out);
Mechanics mechanicsOf(const proto::RecordedMechanics& in);

}  // namespace hl
