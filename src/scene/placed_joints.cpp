#include "scene/placed_joints.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

// In the list of placed shapes, and in five scenes and their worlds at the same time.
constexpr std::size_t kTableCopies = 11;

std::size_t bytesOfTable(const JointSpec& joint) {
  const ForceTable& table = joint.along.table;
  return sizeof(double) * (table.position.size() + table.force.size());
}

// Above those of a file's joints, which count from 1.
constexpr std::uint64_t kClients = std::uint64_t{1} << 63;

bool isBefore(const PlacedShape& x, const PlacedShape& y) {
  return x.object != y.object ? x.object < y.object : x.name < y.name;
}

// Looks up bodies by object and name.
class BodiesByCall {
 public:
  explicit BodiesByCall(std::span<const PlacedShape> placed) {
    for (const PlacedShape& one : placed) {
      if (one.body) bodies_.push_back(&one);
    }
    std::sort(bodies_.begin(), bodies_.end(), [](const auto* x, const auto* y) { return isBefore(*x, *y); });
  }

  const PlacedShape& find(const CalledBody& called, const std::string& joint) const {
    auto at = std::partition_point(bodies_.begin(), bodies_.end(), [&](const PlacedShape* one) {
      return one->object < called.object || (one->object == called.object && one->name < called.name.value_or(0));
    });
    const auto matches = [&] {
      return at != bodies_.end() && (*at)->object == called.object && (!called.name || (*at)->name == *called.name);
    };
    const std::string what = "object " + std::to_string(called.object) +
                             (called.name ? " and name " + std::to_string(*called.name) : std::string());
    if (!matches())
      throw Error(joint + ": the world calls no body of " + what + ": draw one, or the world without the joint");
    const PlacedShape& found = **at;
    ++at;
    if (matches()) throw Error(joint + ": the world calls several bodies of " + what + ": give each call its own name");
    return found;
  }

 private:
  std::vector<const PlacedShape*> bodies_;
};

JointSpec placedJoint(const CalledJoint& called, const BodiesByCall& bodies) {
  JointSpec joint = called.spec;
  const PlacedShape& a = bodies.find(called.a, joint.name);
  bool moves = a.movesAsBody();
  joint.body_a = a.key;
  if (called.b) {
    const PlacedShape& b = bodies.find(*called.b, joint.name);
    moves |= b.movesAsBody();
    joint.body_b = b.key;
  }
  if (joint.body_a == joint.body_b) throw Error(joint.name + ": it joins a body to itself");
  if (!moves) throw Error(joint.name + ": of what it joins, nothing moves");
  return joint;
}

}  // namespace

std::size_t bytesOf(const CalledJoint& joint) { return sizeof(CalledJoint) + bytesOfTable(joint.spec); }

std::size_t bytesOfJoint(const JointSpec& joint) { return kJoint_bytes + kTableCopies * bytesOfTable(joint); }

std::vector<JointSpec> placedJoints(const std::vector<CalledJoint>& joints, std::span<const PlacedShape> placed,
                                    std::uint32_t session, const std::vector<JointSpec>& before) {
  if (joints.empty()) return {};
  const BodiesByCall bodies(placed);
  std::vector<JointSpec> result;
  result.reserve(joints.size());
  for (const CalledJoint& called : joints) {
    JointSpec joint = placedJoint(called, bodies);
    joint.session = session;
    joint.key = kClients | std::uint64_t{session} << 32 | joint.id;
    const auto same = std::find_if(before.begin(), before.end(), [&](const JointSpec& was) {
      return was.key == joint.key && was.kind == joint.kind && was.body_a == joint.body_a && was.body_b == joint.body_b;
    });
    joint.shown = same == before.end() ? std::make_shared<SharedJoint>() : same->shown;
    result.push_back(std::move(joint));
  }
  return result;
}

}  // namespace hl
