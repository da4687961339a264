#include "session/limits.h"

namespace hl {

proto::Limits toProto(const Limits& limits) {
  proto::Limits out;
  out.set_message_bytes(limits.message_bytes);
  out.set_objects(limits.objects);
  out.set_scene_bytes(limits.scene_bytes);
  out.set_instances(limits.instances);
  out.set_texture_bytes(limits.texture_bytes);
  out.set_nesting(limits.nesting);
  out.set_upload_bytes(limits.upload_bytes);
  out.set_frames_hz(limits.frames_Hz);
  out.set_state_rate_hz(limits.state_rate_Hz);
  out.set_bodies(limits.bodies);
  out.set_joints(limits.joints);
  out.set_memory_bytes(limits.memory_bytes);
  return out;
}

}  // namespace hl
