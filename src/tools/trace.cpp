#include "tools/trace.h"

#include <algorithm>
#include <map>

#include "base/clock.h"
#include "bodies/world_hash.h"
#include "scene/scene_model.h"
#include "touch/body_hand.h"

namespace hl {

namespace {

// Of the bodies' clock: it only says which row is before another.
constexpr std::int64_t kRow_ns = 1'000'000;

/// One finger in a scene, and the bodies there.
class Tracer {
 public:
  Tracer(const Snapshot& snapshot, const ProxySettings& settings, const Vec3& begin)
      : snapshot_(snapshot),
        bodies_(BodyWorld::of(snapshot)),
        settings_(settings),
        state_(startProxy(snapshot, settings, begin)) {}

  TickReport tick(std::size_t row, const Vec3& finger, double period_s, FieldForces& fields) {
    settings_.period_s = period_s;
    const std::int64_t now_ns = bodies_ ? static_cast<std::int64_t>(row) * kRow_ns : 0;
    if (bodies_) {
      const HandAtBodies hand = hand_.before(state_, settings_, finger, true);
      bodies_->step(now_ns, settings_.period_s, {&hand, 1});
    }
    const SceneAt scene(snapshot_, now_ns, recent_);
    const TickReport report = hl::tick(state_, scene, settings_, finger);
    fields = fieldForces(scene, finger);
    if (bodies_) hand_.after(*bodies_, 0, scene, state_, report, fields, settings_, finger, true);
    return report;
  }
  const ProxyState& state() const { return state_; }
  /// As TraceRow::snap.
  std::optional<std::size_t> snap() const {
    const std::vector<PlacedSnap>& snaps = snapshot_.snaps;
    if (snaps.empty()) return {};
    const auto holds = [&](const PlacedSnap& snap) {
      return snapshot_.instances[snap.instance].key == state_.snap.key && snap.number == state_.snap.number;
    };
    const auto found = std::find_if(snaps.begin(), snaps.end(), holds);
    return found == snaps.end() ? 0 : static_cast<std::size_t>(found - snaps.begin()) + 1;
  }
  const BodyWorld* bodies() const { return bodies_.get(); }
  /// How bodies and joints are now, after a step of `period_s`.
  void describe(double period_s, TraceRow& row) {
    if (!bodies_) return;
    const World& world = bodies_->world();
    const WorldState& state = bodies_->state();
    traced_.clear();
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
      const BodyState& body = state.bodies[i];
      traced_.push_back({poseOf(world.bodies[i], body).origin, body.turned, body.velocity, body.spin});
    }
    traced_joints_.clear();
    for (std::size_t i = 0; i < state.joints.size(); ++i) {
      const JointState& joint = state.joints[i];
      if (!hasCoordinate(world.joints[i].kind)) continue;
      traced_joints_.push_back({joint.coordinate, joint.velocity, forceAlong(joint, period_s)});
    }
    row.bodies = traced_;
    row.joints = traced_joints_;
    row.world = {kineticEnergy_J(world, state), gravityEnergy_J(world, state), springEnergy_J(world, state),
                 state.energy, hashOf(world, state)};
  }

 private:
  const Snapshot& snapshot_;
  const std::unique_ptr<BodyWorld> bodies_;
  BodyHand hand_;
  ProxySettings settings_;
  ManyRecentPrimitives recent_;
  ProxyState state_;
  std::vector<TracedBody> traced_;
  std::vector<TracedJoint> traced_joints_;
};

}  // namespace

std::vector<std::string> tracedBodies(const Snapshot& snapshot) {
  std::vector<std::string> names;
  for (const Instance& instance : snapshot.instances) {
    if (instance.movesAsBody()) names.push_back(instance.body->name);
  }
  return names;
}

// As the world of the bodies has them, whose making may take long.
std::vector<std::string> tracedJoints(const Snapshot& snapshot) {
  const auto moves = [&](std::uint64_t key) {
    return std::any_of(snapshot.instances.begin(), snapshot.instances.end(),
                       [&](const Instance& instance) { return instance.key == key && instance.movesAsBody(); });
  };
  std::map<std::uint64_t, std::string> by_key;
  std::uint64_t place = 0;
  for (const JointSpec& joint : snapshot.mechanics.joints) {
    ++place;
    if (hasCoordinate(joint.kind) && (moves(joint.body_a) || moves(joint.body_b)))
      by_key[joint.key != 0 ? joint.key : place] = joint.name;
  }
  std::vector<std::string> names;
  names.reserve(by_key.size());
  for (const auto& [key, name] : by_key) names.push_back(name);
  return names;
}

TraceTotals runTrace(const Snapshot& given, const TraceSettings& settings, std::span<const PathSample> path,
                     const std::function<void(const TraceRow&)>& row) {
  TraceTotals totals;
  if (path.empty()) return totals;
  const std::shared_ptr<const Snapshot> own = withOwnBodies(given);
  Tracer tracer(own ? *own : given, settings.proxy, path.front().position);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3& finger = path[i].position;
    const double period_s = i > 0 ? path[i].t - path[i - 1].t : settings.proxy.period_s;
    const std::int64_t start_ns = monotonicNow_ns();
    FieldForces fields;
    const TickReport report = tracer.tick(i, finger, period_s, fields);
    TraceRow out{};
    out.tick_ns = monotonicNow_ns() - start_ns;
    out.t = path[i].t;
    out.finger = finger;
    out.proxy = tracer.state().position;
    out.target = report.target;
    out.force = settings.proxy.spring_N_m * (report.target - finger) + fields.force_N;
    out.contacts = static_cast<int>(report.contacts.size());
    out.iterations = report.iterations;
    out.injected_J = report.injected_J;
    out.snap = tracer.snap();
    out.turned = path[i].turned;
    out.gripper_rad = path[i].gripper_rad;
    tracer.describe(period_s, out);
    row(out);
    if (i == 0) totals.before = out.world;
    totals.after = out.world;
    ++totals.ticks;
    totals.ended.add(report.ending);
    totals.contacts += report.contacts.empty() ? 0 : 1;
  }
  totals.ledger = tracer.state().ledger;
  if (tracer.bodies() != nullptr) totals.returned = tracer.bodies()->view().returned;
  return totals;
}

}  // namespace hl
