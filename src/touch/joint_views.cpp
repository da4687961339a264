#include "touch/joint_views.h"

#include <algorithm>

#include "bodies/joint_in_world.h"

namespace hl {

namespace {

// N, on a: of the rows that hold, those of turns have no line.
Vec3 heldForce_N(const Joint& joint, const JointPlace& place, const JointState& state, double period_s) {
  constexpr double kLever_m = 1;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < heldRows(joint); ++i)
    sum += state.held[i] / period_s * place.row(i, kLever_m, place.point_a, place.point_b).line;
  return sum;
}

ShownJoint shownOf(const Joint& joint, const JointPlace& place, const JointState& state, double period_s) {
  ShownJoint shown;
  shown.held_N = heldForce_N(joint, place, state, period_s);
  if (!hasCoordinate(joint.kind)) return shown;
  shown.coordinate = state.coordinate;
  shown.velocity = state.velocity;
  shown.force = forceAlong(state, period_s);
  return shown;
}

}  // namespace

JointViews::JointViews(const Snapshot& scene, const World& world) {
  for (const JointSpec& spec : scene.mechanics.joints) {
    if (!spec.shown) continue;
    const auto at = std::lower_bound(world.joints.begin(), world.joints.end(), spec.key,
                                     [](const Joint& joint, std::uint64_t key) { return joint.key < key; });
    if (at == world.joints.end() || at->key != spec.key) continue;
    views_.push_back({static_cast<std::size_t>(at - world.joints.begin()), world.numberOf(at->body_a),
                      at->body_a != spec.body_a, false, spec.shown});
  }
}

void JointViews::show(const World& world, const WorldState& state, double period_s) {
  for (One& one : views_) {
    const bool asleep = state.bodies[one.body].island != 0;
    if (asleep && one.asleep) continue;
    one.asleep = asleep;
    const Joint& joint = world.joints[one.joint];
    ShownJoint shown = shownOf(joint, jointPlace(joint, world, state), state.joints[one.joint], period_s);
    if (one.turned_round) shown.held_N = -shown.held_N;
    one.shown->write(shown);
  }
}

}  // namespace hl
