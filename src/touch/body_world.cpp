#include "touch/body_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "bodies/scene_world.h"
#include "bodies/sleep.h"

namespace hl {

namespace {

std::vector<Pose> startsOf(const std::vector<std::shared_ptr<const RigidBody>>& bodies) {
  std::vector<Pose> poses;
  poses.reserve(bodies.size());
  for (const auto& body : bodies) poses.push_back(body->start);
  return poses;
}

// False: there is no room.
bool addTo(FixedVector<BodyImpulse, kContactsOfHand>& list, const BodyImpulse& impulse) {
  for (BodyImpulse& one : list) {
    if (one.key != impulse.key) continue;
    one.impulse_N_s += impulse.impulse_N_s;
    one.point = impulse.point;
    return true;
  }
  return list.push(impulse);
}

bool isFinite(const BodyState& body) {
  return std::isfinite(body.centre.sum() + body.velocity.sum() + body.spin.sum() + body.turned.coeffs().sum());
}

// A hand that does not pull holds nothing, and only pays.
HandNode nodeOf(const HandAtBodies& hand, const FixedVector<BodyImpulse, kContactsOfHand>& owed) {
  HandNode node;
  node.proxy = hand.proxy;
  node.stretch = hand.stretch;
  node.owed = owed;
  node.spring_N_m = 1;
  if (!(hand.spring_N_m > 0)) return node;
  node.radius_m = hand.radius_m;
  node.spring_N_m = hand.spring_N_m;
  node.contacts = hand.contacts;
  return node;
}

}  // namespace

BodyWorld::BodyWorld(const std::shared_ptr<const World>& world, std::vector<std::shared_ptr<const RigidBody>> bodies,
                     JointViews joint_views)
    : bodies_(std::move(bodies)),
      stepper_(world),
      state_(startWorld(*world, startsOf(bodies_))),
      joint_views_(std::move(joint_views)) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    state_.bodies[i].velocity = bodies_[i]->spec.velocity_m_s;
    state_.bodies[i].spin = bodies_[i]->spec.spin_rad_s;
  }
  view_.bodies = bodies_.size();
  starts_ = state_.bodies;
  joint_starts_ = state_.joints;
  lost_.resize(bodies_.size());
}

std::unique_ptr<BodyWorld> BodyWorld::of(const Snapshot& snapshot) {
  const std::shared_ptr<const World> world = worldOf(snapshot);
  if (!world) return nullptr;
  std::vector<std::shared_ptr<const RigidBody>> bodies;  // as World::bodies: both are sorted by key
  for (const Instance& instance : snapshot.instances) {
    if (instance.movesAsBody()) bodies.push_back(instance.body);
  }
  return std::unique_ptr<BodyWorld>(new BodyWorld(world, std::move(bodies), JointViews(snapshot, *world)));
}

void BodyWorld::continueFrom(const BodyWorld& before) {
  std::size_t j = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::uint64_t key = world().bodies[i].key;
    while (j < before.bodies_.size() && before.world().bodies[j].key < key) ++j;
    if (j == before.bodies_.size() || before.world().bodies[j].key != key) continue;
    const bool goes_on = before.bodies_[j]->start == bodies_[i]->start;
    if (goes_on) {
      state_.bodies[i] = before.state_.bodies[j];
      // Of another shape the object frame stays where it is, and not the centre of mass.
      const Body &now = world().bodies[i], &was = before.world().bodies[j];
      if (now.mass.centre_O != was.mass.centre_O)
        state_.bodies[i].centre = poseOf(was, before.state_.bodies[j]).toWorld(now.mass.centre_O);
    }
    if (goes_on && before.bodies_[j]->poses == bodies_[i]->poses) continue;
    bodies_[i]->poses->jumpTo(shownOf(i));
  }
  continueJoints(before);
  state_.memory.copyFrom(before.state_.memory);
  state_.asleep.copyFrom(before.state_.asleep);
  state_.gravity_m_s2 = before.state_.gravity_m_s2;
  if (!standsAs(before)) wakeAll(state_);
  state_.energy = before.state_.energy;
  state_.energy.by_client_J += energy_J() - before.energy_J();  // of bodies that come and go, and of another gravity
  pushes_ = before.pushes_;
  state_.steps = before.state_.steps;
  accounts_ = before.accounts_;
  for (Account& account : accounts_) forgetOwed(account, before);
  view_ = before.view_;
  view_.bodies = bodies_.size();
  time_ns_ = before.time_ns_;
  begun_ = before.begun_;
}

// What is owed to a body that does not go on here is owed to nobody.
void BodyWorld::forgetOwed(Account& account, const BodyWorld& before) const {
  std::size_t kept = 0;
  for (const BodyImpulse& owed : account.owed) {
    if (world().has(owed.key) && goesOn(owed.key, before)) account.owed[kept++] = owed;
  }
  account.owed.resize(kept);
}

// Whether the bodies are those of before, and so is what holds them, but for what moves: that wakes what is near it.
bool BodyWorld::standsAs(const BodyWorld& before) const {
  const World &now = world(), &was = before.world();
  if (bodies_ != before.bodies_ || now.joints != was.joints || now.fixed_surfaces != was.fixed_surfaces) return false;
  const auto same = [](const Instance& a, const Instance& b) {
    return a.key == b.key && a.shape == b.shape && (a.poses().moves() || a.poses().to() == b.poses().to());
  };
  if (!now.fixed || !was.fixed) return now.fixed == was.fixed;
  return std::equal(now.fixed->instances.begin(), now.fixed->instances.end(), was.fixed->instances.begin(),
                    was.fixed->instances.end(), same);
}

// Whether a body of this key goes on here from where it was in `before`; so does the world, of key 0.
bool BodyWorld::goesOn(std::uint64_t key, const BodyWorld& before) const {
  if (key == 0) return true;
  const std::size_t was = before.world().numberOf(key);
  return was != World::kNoBody && before.bodies_[was]->start == bodies_[world().numberOf(key)]->start;
}

// A joint goes on that is one of the same kind between the same bodies, which go on.
void BodyWorld::continueJoints(const BodyWorld& before) {
  const std::vector<Joint>&joints = world().joints, &last = before.world().joints;
  std::size_t j = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    while (j < last.size() && last[j].key < joints[i].key) ++j;
    if (j == last.size()) return;
    const bool same = last[j].key == joints[i].key && last[j].kind == joints[i].kind &&
                      last[j].body_a == joints[i].body_a && last[j].body_b == joints[i].body_b;
    if (same && goesOn(joints[i].body_a, before) && goesOn(joints[i].body_b, before))
      state_.joints[i] = before.state_.joints[j];
  }
}

bool BodyWorld::remember(BodiesMemory& out) const {
  if (!out.hasRoomFor(world())) return false;
  out.world = state_;
  out.poses.clear();
  for (const auto& body : bodies_) out.poses.push_back(body->poses->to());
  out.owed = accounts_[0].owed;
  out.drawn = accounts_[0].drawn;
  out.pushes = pushes_;
  out.time_ns = time_ns_;
  out.begun = begun_;
  return true;
}

void BodyWorld::resume(const BodiesMemory& memory) {
  if (memory.world.bodies.size() != bodies_.size() || memory.poses.size() != bodies_.size() ||
      memory.world.joints.size() != state_.joints.size())
    throw Error("what the bodies remember is of another scene");
  state_ = memory.world;
  if (!sleepsWhole(world(), state_)) wakeAll(state_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyState& body = state_.bodies[i];
    bodies_[i]->poses->jumpTo({memory.poses[i], body.velocity, body.spin});
  }
  accounts_[0].owed = memory.owed;
  accounts_[0].drawn = memory.drawn;
  pushes_ = memory.pushes;
  time_ns_ = memory.time_ns;
  begun_ = memory.begun;
}

void BodyWorld::set(std::size_t i, const Vec3& velocity, const Vec3& spin) {
  wake(world(), state_, world().bodies[i].key);
  state_.bodies[i].velocity = velocity;
  state_.bodies[i].spin = spin;
}

ShownBody BodyWorld::shownOf(std::size_t i) const {
  const BodyState& body = state_.bodies[i];
  return {poseOf(world().bodies[i], body), body.velocity, body.spin};
}

double BodyWorld::energyOf_J(std::size_t i) const {
  const Body& body = world().bodies[i];
  const BodyState& state = state_.bodies[i];
  return kineticEnergy_J(body, state) - body.mass.mass_kg * world().gravity_m_s2.dot(state.centre);
}

double BodyWorld::energy_J() const {
  return kineticEnergy_J(world(), state_) + gravityEnergy_J(world(), state_) + springEnergy_J(world(), state_);
}

void BodyWorld::act(const BodyCommands& commands) {
  for (const BodyCommand& command : commands) act(command);
}

void BodyWorld::act(const BodyCommand& command) {
  const std::size_t i = world().numberOf(command.key);
  if (i == World::kNoBody) return;
  BodyState& state = state_.bodies[i];
  const double before_J = energyOf_J(i);
  wake(world(), state_, command.key);
  if (command.position_m || command.rotation) place(i, command);
  if (command.velocity_m_s) state.velocity = *command.velocity_m_s;
  if (command.spin_rad_s) state.spin = *command.spin_rad_s;
  const Vec3 point = command.point_m.value_or(state.centre);
  BodyPush over_time{command.key, poseOf(world().bodies[i], state).toObject(point), command.impulse_N_s,
                     command.duration_s};
  if (command.duration_s > 0) over_time.force_N /= command.duration_s;
  // Of more than there is room for, the whole is given at once.
  if (!(command.duration_s > 0) || !pushes_.push(over_time)) give(i, command.impulse_N_s, point);
  state_.energy.by_client_J += energyOf_J(i) - before_J;
}

void BodyWorld::place(std::size_t i, const BodyCommand& command) {
  BodyState& state = state_.bodies[i];
  Pose pose = poseOf(world().bodies[i], state);
  if (command.position_m) pose.origin = *command.position_m;
  if (command.rotation) state.turned = Eigen::Quaterniond(*command.rotation).normalized();
  pose.rotation = state.turned.toRotationMatrix();
  state.centre = pose.toWorld(world().bodies[i].mass.centre_O);
  bodies_[i]->poses->jumpTo(shownOf(i));
}

// However light the body is, it is not made faster than bodies may be.
void BodyWorld::give(std::size_t i, const Vec3& impulse_N_s, const Vec3& point) {
  const Body& body = world().bodies[i];
  BodyState& state = state_.bodies[i];
  state.velocity = limited(state.velocity + impulse_N_s / body.mass.mass_kg, kFastest_m_s);
  state.spin =
      limited(state.spin + inverseInertia(body, state) * (point - state.centre).cross(impulse_N_s), kFastest_rad_s);
}

// What is given over time, in a step of this length.
void BodyWorld::push(double period_s) {
  std::size_t kept = 0;
  for (const BodyPush& one : pushes_) {
    const std::size_t i = world().numberOf(one.key);
    if (i == World::kNoBody) continue;
    const double before_J = energyOf_J(i);
    wake(world(), state_, one.key);
    const Vec3 point = poseOf(world().bodies[i], state_.bodies[i]).toWorld(one.point_O);
    give(i, std::min(period_s, one.left_s) * one.force_N, point);
    state_.energy.by_client_J += energyOf_J(i) - before_J;
    BodyPush left = one;
    left.left_s -= period_s;
    if (left.left_s > 0) pushes_[kept++] = left;
  }
  pushes_.resize(kept);
}

// In whole, before the step: so a body swings about a field as by symplectic Euler.
void BodyWorld::payDrawn() {
  for (Account& account : accounts_) {
    for (const BodyImpulse& one : account.drawn) giveByHand(one);
    account.drawn.clear();
  }
}

void BodyWorld::giveByHand(const BodyImpulse& one) {
  const std::size_t i = world().numberOf(one.key);
  if (i == World::kNoBody) return;
  const double before_J = energyOf_J(i);
  wake(world(), state_, one.key);
  give(i, one.impulse_N_s, one.point);
  state_.energy.by_hand_J += energyOf_J(i) - before_J;
}

void BodyWorld::draw(std::size_t hand, const FieldForces& fields, double period_s) {
  DrawnImpulses& drawn = accounts_[hand].drawn;
  drawn.clear();
  for (const ObjectForce& force : fields.forces) {
    if (world().has(force.key)) drawn.push({force.key, force.point, -period_s * force.force_N});
  }
}

// The bodies and the hands that pull, or have something to pay. What was owed to a body is owed no more as far as it
// was given.
void BodyWorld::stepAmong(std::span<const HandAtBodies> hands, double period_s, const StepTimes& times) {
  FixedVector<HandNode, kMaxHands> nodes;
  FixedVector<Account*, kMaxHands> of_node;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    Account& account = accounts_[i];
    if (!(hands[i].spring_N_m > 0) && account.owed.empty()) continue;
    nodes.push(nodeOf(hands[i], account.owed));
    of_node.push(&account);
  }
  std::array<GivenImpulses, kMaxHands> given;
  report_ = stepper_.step(state_, period_s, {nodes.begin(), nodes.size()}, {given.data(), nodes.size()}, times);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Account& account = *of_node[i];
    account.given = given[i];
    account.paid = 0;  // in the order of `owed`; what sleeps and is owed nothing got nothing
    for (BodyImpulse& owed : account.owed) {
      if (account.paid == account.given.size() || account.given[account.paid].key != owed.key) continue;
      owed.impulse_N_s -= account.given[account.paid].impulse_N_s;
      ++account.paid;
    }
  }
}

// Here and not where the world is made: another loop may use the same poses then.
void BodyWorld::showMobility() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Mass& mass = world().bodies[i].mass;
    bodies_[i]->poses->setMobility({1 / mass.mass_kg, mass.inertia_kg_m2.inverse(), mass.centre_O});
  }
}

void BodyWorld::step(std::int64_t now_ns, double period_s, std::span<const HandAtBodies> hands) {
  const std::int64_t before_ns = time_ns_;
  time_ns_ = now_ns;
  const bool first = !begun_;
  begun_ = true;
  for (Account& account : accounts_) {
    account.given.clear();
    account.paid = 0;
  }
  if (!std::exchange(mobility_shown_, true)) showMobility();
  if (first || now_ns <= before_ns) return;
  returnBroken();
  push(period_s);
  payDrawn();
  const EnergyBook before = state_.energy;
  stepAmong(hands, period_s, {before_ns, now_ns});
  for (const std::size_t i : stepper_.awake()) bodies_[i]->poses->moveTo(shownOf(i), before_ns, now_ns);
  returnLost(before);
  joint_views_.show(world(), state_, period_s);
  count(seconds(now_ns - before_ns) - period_s);
}

// The sums over all bodies are for people who look: not in every step.
void BodyWorld::count(double late_s) {
  view_.lost_s += std::max(0.0, late_s);
  view_.dropped += report_.dropped;
  view_.unsolved += report_.converged ? 0 : 1;
  view_.steps = state_.steps;
  view_.awake = static_cast<std::uint64_t>(report_.awake);
  if (state_.steps % kViewEvery != 0) return;
  view_.energy = state_.energy;
  view_.kinetic_J = kineticEnergy_J(world(), state_);
  view_.spring_J = springEnergy_J(world(), state_);
  view_.gravity_J = gravityEnergy_J(world(), state_);
}

// A state that is not finite would spread to all that the body meets.
void BodyWorld::returnBroken() {
  if (findLost([&](std::size_t i) { return state_.bodies[i].island == 0 && !isFinite(state_.bodies[i]); }))
    putBackLost();
}

// So that nothing is lost that falls from a table, and no body is ever so far away that its place is inexact. `before`:
// what was booked before the step. What a step has lost or given that comes to no finite state is not known.
void BodyWorld::returnLost(const EnergyBook& before) {
  bool broken = false;
  const bool any = findLost([&](std::size_t i) {
    const Vec3& centre = state_.bodies[i].centre;
    const Box& room = bodies_[i]->poses->room();
    const bool finite = isFinite(state_.bodies[i]);
    broken |= !finite;
    return !finite || (centre.array() < room.min.array()).any() || (centre.array() > room.max.array()).any();
  });
  if (!any) return;
  if (broken) forgetStep(before);
  const double before_J = energy_J();
  putBackLost();
  if (!broken) state_.energy.solver_J += energy_J() - before_J;
}

// The next step must not begin from what is not finite.
void BodyWorld::forgetStep(const EnergyBook& before) {
  state_.energy = before;
  state_.memory.clear();
  for (Account& account : accounts_) {
    account.owed.clear();
    account.given.clear();
    account.paid = 0;
  }
}

bool BodyWorld::findLost(FunctionRef<bool(std::size_t body)> is_lost) {
  bool any = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    lost_[i] = is_lost(i) ? 1 : 0;
    any |= lost_[i] != 0;
  }
  return any;
}

void BodyWorld::putBackLost() {
  loseJoined();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (lost_[i] != 0) putBack(i);
  }
}

// What joints connect goes together, or it would be torn apart.
void BodyWorld::loseJoined() {
  const std::span<const std::uint32_t> groups = stepper_.groups();
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    if (lost_[i] != 0) lost_[groups[i]] = 1;
  }
  for (std::size_t i = 0; i < lost_.size(); ++i) lost_[i] = lost_[groups[i]];
  for (std::size_t i = 0; i < world().joints.size(); ++i) {
    if (lost_[world().numberOf(world().joints[i].body_a)] != 0) state_.joints[i] = joint_starts_[i];
  }
}

void BodyWorld::putBack(std::size_t i) {
  wake(world(), state_, world().bodies[i].key);
  state_.bodies[i] = starts_[i];
  state_.bodies[i].velocity.setZero();
  state_.bodies[i].spin.setZero();
  bodies_[i]->poses->jumpTo(bodies_[i]->start);
  ++view_.returned;
}

// Of each object: what the hand felt, less what the step has given, beside what is owed from before. What a wall has
// given through the proxy to a body that is pinched against it is owed to nobody: it acts on both, one against the
// other.
void BodyWorld::settle(std::size_t hand, const ObjectForces& forces, double period_s) {
  Account& account = accounts_[hand];
  FixedVector<BodyImpulse, kContactsOfHand> changes;
  Vec3 of_fixed = Vec3::Zero();
  const auto add = [&](std::uint64_t key, const Vec3& point, const Vec3& impulse) {
    if (!world().has(key))
      of_fixed += impulse;
    else
      addTo(changes, {key, point, impulse});
  };
  for (const ObjectForce& force : forces) add(force.key, force.point, -period_s * force.force_N);
  for (std::size_t i = account.paid; i < account.given.size(); ++i)
    add(account.given[i].key, account.given[i].point, -account.given[i].impulse_N_s);
  for (BodyImpulse& change : changes) {
    const Vec3 with_wall = change.impulse_N_s + of_fixed;
    if (with_wall.squaredNorm() < change.impulse_N_s.squaredNorm()) {
      change.impulse_N_s = with_wall;
      of_fixed.setZero();
    }
    owe(account, change);
  }
}

// Of more bodies than there is room for, that which is owed the least gets it at once.
void BodyWorld::owe(Account& account, const BodyImpulse& change) {
  auto& owed = account.owed;
  if (addTo(owed, change)) return;
  const auto less = [](const BodyImpulse& a, const BodyImpulse& b) {
    return a.impulse_N_s.squaredNorm() < b.impulse_N_s.squaredNorm();
  };
  BodyImpulse& least = *std::min_element(owed.begin(), owed.end(), less);
  giveByHand(least);
  least = change;
}

Vec3 BodyWorld::owed_N_s() const {
  Vec3 sum = Vec3::Zero();
  for (const Account& account : accounts_) {
    for (const BodyImpulse& one : account.owed) sum += one.impulse_N_s;
    for (const BodyImpulse& one : account.drawn) sum += one.impulse_N_s;
  }
  return sum;
}

}  // namespace hl
