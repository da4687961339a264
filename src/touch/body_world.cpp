#include "touch/body_world.h"

#include <algorithm>

#include "base/error.h"
#include "bodies/scene_world.h"

namespace hl {

namespace {

std::vector<Pose> startsOf(const std::vector<std::shared_ptr<const RigidBody>>& bodies) {
  std::vector<Pose> poses;
  poses.reserve(bodies.size());
  for (const auto& body : bodies) poses.push_back(body->start);
  return poses;
}

void addTo(FixedVector<BodyImpulse, kContactsOfHand>& list, const BodyImpulse& impulse) {
  for (BodyImpulse& one : list) {
    if (one.key != impulse.key) continue;
    one.impulse_N_s += impulse.impulse_N_s;
    one.point = impulse.point;
    return;
  }
  list.push(impulse);
}

}  // namespace

BodyWorld::BodyWorld(const std::shared_ptr<const World>& world, std::vector<std::shared_ptr<const RigidBody>> bodies)
    : bodies_(std::move(bodies)), stepper_(world), state_(startWorld(*world, startsOf(bodies_))) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) state_.bodies[i] = startOf(i);
  view_.bodies = bodies_.size();
}

std::unique_ptr<BodyWorld> BodyWorld::of(const Snapshot& snapshot) {
  const std::shared_ptr<const World> world = worldOf(snapshot);
  if (!world) return nullptr;
  std::vector<std::shared_ptr<const RigidBody>> bodies;  // as World::bodies: both are sorted by key
  for (const Instance& instance : snapshot.instances) {
    if (instance.movesAsBody()) bodies.push_back(instance.body);
  }
  return std::unique_ptr<BodyWorld>(new BodyWorld(world, std::move(bodies)));
}

BodyState BodyWorld::startOf(std::size_t i) const {
  const RigidBody& body = *bodies_[i];
  BodyState state;
  state.turned = Eigen::Quaterniond(body.start.rotation).normalized();
  state.centre = body.start.toWorld(world().bodies[i].mass.centre_O);
  state.velocity = body.spec.velocity_m_s;
  state.spin = body.spec.spin_rad_s;
  return state;
}

void BodyWorld::continueFrom(const BodyWorld& before) {
  std::size_t j = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::uint64_t key = world().bodies[i].key;
    while (j < before.bodies_.size() && before.world().bodies[j].key < key) ++j;
    if (j == before.bodies_.size() || before.world().bodies[j].key != key) continue;
    const bool goes_on = before.bodies_[j]->start == bodies_[i]->start;
    if (goes_on) state_.bodies[i] = before.state_.bodies[j];
    if (goes_on && before.bodies_[j]->poses == bodies_[i]->poses) continue;
    bodies_[i]->poses->jumpTo(poseOf(world().bodies[i], state_.bodies[i]));
  }
  continueJoints(before);
  state_.memory.copyFrom(before.state_.memory);
  state_.energy = before.state_.energy;
  state_.steps = before.state_.steps;
  owed_ = before.owed_;
  view_ = before.view_;
  view_.bodies = bodies_.size();
  time_ns_ = before.time_ns_;
  begun_ = before.begun_;
}

// A joint that is as it was: between the same bodies, with the same forces along it.
void BodyWorld::continueJoints(const BodyWorld& before) {
  const std::vector<Joint>&joints = world().joints, &last = before.world().joints;
  std::size_t j = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    while (j < last.size() && last[j].key < joints[i].key) ++j;
    if (j == last.size()) return;
    const bool same = last[j].key == joints[i].key && last[j].kind == joints[i].kind &&
                      last[j].body_a == joints[i].body_a && last[j].body_b == joints[i].body_b;
    if (same) state_.joints[i] = before.state_.joints[j];
  }
}

bool BodyWorld::remember(BodiesMemory& out) const {
  if (!out.hasRoomFor(world())) return false;
  out.world = state_;
  out.poses.clear();
  for (const auto& body : bodies_) out.poses.push_back(body->poses->to());
  out.owed = owed_;
  out.time_ns = time_ns_;
  out.begun = begun_;
  return true;
}

void BodyWorld::resume(const BodiesMemory& memory) {
  if (memory.world.bodies.size() != bodies_.size() || memory.poses.size() != bodies_.size())
    throw Error("what the bodies remember is of another scene");
  state_ = memory.world;
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->poses->jumpTo(memory.poses[i]);
  owed_ = memory.owed;
  time_ns_ = memory.time_ns;
  begun_ = memory.begun;
}

void BodyWorld::step(std::int64_t now_ns, double period_s, const HandAtBodies& hand) {
  const std::int64_t before_ns = time_ns_;
  time_ns_ = now_ns;
  const bool first = !begun_;
  begun_ = true;
  given_.clear();
  paid_ = 0;
  if (first || now_ns <= before_ns) return;
  HandNode node;
  node.proxy = hand.proxy;
  node.radius_m = hand.spring_N_m > 0 ? hand.radius_m : 0;
  node.stretch = hand.stretch;
  node.spring_N_m = hand.spring_N_m;
  if (hand.spring_N_m > 0) node.contacts = hand.contacts;
  node.owed = owed_;
  const bool there = hand.spring_N_m > 0 || !owed_.empty();
  if (!(node.spring_N_m > 0)) node.spring_N_m = 1;
  report_ = stepper_.step(state_, period_s, std::span(&node, there ? 1 : 0), std::span(&given_, there ? 1 : 0));
  if (!there) given_.clear();
  paid_ = there ? node.owed.size() : 0;
  for (std::size_t i = 0; i < paid_ && i < given_.size(); ++i) owed_[i].impulse_N_s -= given_[i].impulse_N_s;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_[i]->poses->moveTo(poseOf(world().bodies[i], state_.bodies[i]), before_ns, now_ns);
  returnLost();
  count(1e-9 * static_cast<double>(now_ns - before_ns) - period_s);
}

// The sums over all bodies are for people who look: not in every step.
void BodyWorld::count(double late_s) {
  view_.lost_s += std::max(0.0, late_s);
  view_.dropped += report_.dropped;
  view_.unsolved += report_.converged ? 0 : 1;
  view_.steps = state_.steps;
  if (state_.steps % kViewEvery != 0) return;
  view_.energy = state_.energy;
  view_.kinetic_J = kineticEnergy_J(world(), state_);
  view_.spring_J = springEnergy_J(world(), state_);
  view_.gravity_J = gravityEnergy_J(world(), state_);
}

// Kinetic, and that of gravity.
double BodyWorld::energyOf_J(std::size_t i) const {
  const Body& body = world().bodies[i];
  const BodyState& state = state_.bodies[i];
  const double turning_J = state.spin.dot(inertiaOf(body, state) * state.spin) / 2;
  const Vec3& gravity = world().gravity_m_s2;
  return turning_J + body.mass.mass_kg * (state.velocity.squaredNorm() / 2 - gravity.dot(state.centre));
}

// So that nothing is lost that falls from a table, and no body is ever so far away that its place is inexact.
void BodyWorld::returnLost() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Vec3& centre = state_.bodies[i].centre;
    const Box& room = bodies_[i]->poses->room();
    if ((centre.array() >= room.min.array()).all() && (centre.array() <= room.max.array()).all()) continue;
    const double before_J = energyOf_J(i);
    state_.bodies[i] = startOf(i);
    state_.bodies[i].velocity.setZero();
    state_.bodies[i].spin.setZero();
    state_.energy.solver_J += energyOf_J(i) - before_J;
    bodies_[i]->poses->jumpTo(bodies_[i]->start);
    ++view_.returned;
  }
}

// Of each object: what the hand felt, less what the step has given, beside what is owed from before. What a wall has
// given through the proxy to a body that is pinched against it is owed to nobody: it acts on both, one against the
// other.
void BodyWorld::settle(const ObjectForces& forces, double period_s) {
  FixedVector<BodyImpulse, kContactsOfHand> changes;
  Vec3 of_fixed = Vec3::Zero();
  const auto add = [&](std::uint64_t key, const Vec3& point, const Vec3& impulse) {
    if (world().find(key) == nullptr)
      of_fixed += impulse;
    else
      addTo(changes, {key, point, impulse});
  };
  for (const ObjectForce& force : forces) add(force.key, force.point, -period_s * force.force_N);
  for (std::size_t i = paid_; i < given_.size(); ++i) add(given_[i].key, given_[i].point, -given_[i].impulse_N_s);
  for (BodyImpulse& change : changes) {
    const Vec3 with_wall = change.impulse_N_s + of_fixed;
    if (with_wall.squaredNorm() < change.impulse_N_s.squaredNorm()) {
      change.impulse_N_s = with_wall;
      of_fixed.setZero();
    }
    addTo(owed_, change);
  }
}

Vec3 BodyWorld::owed_N_s() const {
  Vec3 sum = Vec3::Zero();
  for (const BodyImpulse& one : owed_) sum += one.impulse_N_s;
  return sum;
}

}  // namespace hl
