#include "session/check_bodies.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "bodies/joint_check.h"
#include "bodies/joint_start.h"
#include "bodies/made_bodies.h"
#include "bodies/scene_world.h"

namespace hl {

namespace {

using ShapeOfBody = std::pair<const Shape*, const BodySpec*>;

// A joint's message numbers it by its key: here that is the client's own number.
void checkJointsOf(const PlacedList& placed) {
  std::map<std::uint64_t, Pose> starts;
  for (const PlacedShape& one : placed) {
    if (one.body && !placed.joints.empty()) starts.emplace(one.key, one.pose);
  }
  for (JointSpec joint : placed.joints) {
    joint.key = joint.id;
    checkJoint(jointOf(joint, starts[joint.body_a], starts[joint.body_b]),
               [&](std::uint64_t body) { return starts.contains(body); });
  }
}

void checkHands(std::size_t devices) {
  if (devices > kMaxHands)
    throw Error("rigid bodies that move are touched by at most " + std::to_string(kMaxHands) +
                " devices, and the server has " + std::to_string(devices) + ": give them fixed, or start fewer");
}

}  // namespace

WorldParts partsOf(const Snapshot& scene) { return {partsIn(scene), scene.mechanics.joints.size()}; }

WorldParts checkBodies(const PlacedList& placed) {
  std::map<ShapeOfBody, std::size_t> parts;
  std::size_t count = 0;
  for (const PlacedShape& one : placed) {
    if (!one.movesAsBody()) continue;
    const auto [its_parts, is_first] = parts.try_emplace({one.shape.get(), one.body.get()}, 0);
    try {
      if (is_first) its_parts->second = madeBody(one.shape, *one.body)->shape.parts.size();
    } catch (const Error& error) {
      throw Error("object " + std::to_string(one.object) + ".body: " + error.what());
    }
    count += its_parts->second;
  }
  checkJointsOf(placed);
  return {count, placed.joints.size()};
}

std::vector<std::string> warningsOfNewBodies(const PlacedList& placed, const PlacedList& before) {
  std::set<ShapeOfBody> known;
  for (const PlacedShape& one : before) {
    if (one.movesAsBody()) known.insert({one.shape.get(), one.body.get()});
  }
  std::vector<std::string> warnings;
  for (const PlacedShape& one : placed) {
    if (!one.movesAsBody() || !known.insert({one.shape.get(), one.body.get()}).second) continue;
    for (const std::string& warning : partsWarnings(one.shape, *one.body))
      warnings.push_back("object " + std::to_string(one.object) + ".body: " + warning);
  }
  return warnings;
}

void checkHandsAtBodies(const Snapshot& scene, std::size_t devices) {
  if (movingBodies(scene) > 0) checkHands(devices);
}

void checkBodiesOfAll(const WorldParts& all, const WorldParts& most, std::size_t devices) {
  const auto check = [](std::size_t count, std::size_t limit, const char* what) {
    if (count > limit)
      throw Error("there are more than " + std::to_string(limit) + " " + what +
                  " in the world, those of other clients among them");
  };
  checkHands(devices);
  check(all.bodies, most.bodies, "bodies");
  check(all.joints, most.joints, "joints");
}

Box boundsForBodies(const Snapshot& base, const std::vector<PlacedShape>& placed) {
  if (std::none_of(placed.begin(), placed.end(), [](const PlacedShape& one) { return one.movesAsBody(); })) return {};
  Box bounds = base.bounds;
  for (const PlacedShape& one : placed) bounds.extend(boxAt(one.shape->bounds, one.pose));
  return bounds;
}

}  // namespace hl
