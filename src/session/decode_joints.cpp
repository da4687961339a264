#include "session/decode_joints.h"

#include <set>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

CalledBody calledBody(const proto::CalledBody& in, const std::string& where) {
  if (in.object() == 0) throw Error(where + ".object must not be 0");
  CalledBody body{in.object(), {}};
  if (in.has_name()) body.name = in.name();
  return body;
}

CalledJoint calledJoint(const proto::WorldJoint& in, const SceneDecoder& decoder, const std::string& where) {
  if (!in.joint().name().empty() || !in.joint().body_a().empty() || !in.joint().body_b().empty())
    throw Error(where + ".joint: name, bodyA and bodyB are of scene files: leave them out");
  CalledJoint joint{decoder.joint(in.joint(), where), calledBody(in.body_a(), where + ".bodyA"), {}};
  joint.spec.name = where;
  joint.spec.id = in.id();
  if (in.has_body_b()) joint.b = calledBody(in.body_b(), where + ".bodyB");
  return joint;
}

}  // namespace

std::vector<CalledJoint> decodeJoints(const proto::World& world, const SceneDecoder& decoder, const SceneLimits& limits,
                                      MemoryShare& memory) {
  const auto count = static_cast<std::size_t>(world.joints_size());
  if (count > limits.joints)
    throw Error("there are more than " + std::to_string(limits.joints) + " joints in the world");
  std::vector<CalledJoint> joints;
  joints.reserve(count);
  std::set<std::uint32_t> ids;
  for (int i = 0; i < world.joints_size(); ++i) {
    const proto::WorldJoint& in = world.joints(i);
    if (in.id() == 0) throw Error(pathOf("world.joints", i) + ".id must not be 0");
    const std::string where = "joint " + std::to_string(in.id());
    if (!ids.insert(in.id()).second) throw Error(where + " is there twice");
    joints.push_back(calledJoint(in, decoder, where));
    memory.take(bytesOf(joints.back()));
  }
  return joints;
}

}  // namespace hl
