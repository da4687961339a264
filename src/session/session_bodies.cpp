#include "session/session_bodies.h"

#include <algorithm>

#include "io/vec_messages.h"
#include "session/state_messages.h"

namespace hl {

void SessionBodies::follow(const Snapshot& scene) {
  if (scene.identity == scene_) return;
  scene_ = scene.identity;
  bodies_.clear();
  for (const Instance& instance : scene.instances) {
    if (instance.session == session_ && instance.movesAsBody())
      bodies_.push_back({instance.key, instance.object, instance.name, instance.body});
  }
  std::stable_sort(bodies_.begin(), bodies_.end(), [](const One& x, const One& y) {
    return x.object != y.object ? x.object < y.object : x.name < y.name;
  });
  joints_.clear();
  for (const JointSpec& joint : scene.mechanics.joints) {
    if (joint.session == session_ && joint.shown) joints_.push_back({joint.id, joint.shown});
  }
  std::sort(joints_.begin(), joints_.end(), [](const OneJoint& x, const OneJoint& y) { return x.id < y.id; });
}

void SessionBodies::describe(proto::ClientState& out) const {
  for (const One& one : bodies_) {
    const ShownBody shown = one.body->poses->shown();
    const Eigen::Quaterniond turned(shown.pose.rotation);
    proto::BodyState& state = *out.add_bodies();
    state.set_object(one.object);
    state.set_name(one.name);
    toProto(shown.pose.origin, *state.mutable_position());
    toProto(turned, *state.mutable_rotation());
    toProto(shown.velocity_m_s, *state.mutable_velocity_m_s());
    toProto(shown.spin_rad_s, *state.mutable_spin_rad_s());
  }
  for (const OneJoint& one : joints_) {
    const ShownJoint shown = one.shown->read();
    proto::JointState& state = *out.add_joints();
    state.set_id(one.id);
    state.set_coordinate(shown.coordinate);
    state.set_velocity(shown.velocity);
    state.set_force(shown.force);
    toProto(shown.held_N, *state.mutable_held_n());
  }
}

std::vector<std::uint64_t> SessionBodies::keysOf(std::uint32_t object, std::optional<std::uint32_t> name) const {
  std::vector<std::uint64_t> keys;
  for (const One& one : bodies_) {
    if (one.object == object && (!name || one.name == *name)) keys.push_back(one.key);
  }
  return keys;
}

}  // namespace hl
