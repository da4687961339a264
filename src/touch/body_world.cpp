#include "touch/body_world.h"

#include <algorithm>
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

// A hand that does not pull holds nothing, and only pays.
HandNode nodeOf(const HandAtBodies& hand, const OwedImpulses& owed) {
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
      joint_views_(std::move(joint_views)),
      lost_(state_) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    state_.bodies[i].velocity = bodies_[i]->spec.velocity_m_s;
    state_.bodies[i].spin = bodies_[i]->spec.spin_rad_s;
  }
  view_.bodies = bodies_.size();
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
    bodies_[i]->poses->jumpTo(moving().shown(i));
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
  // What is owed to a body that does not go on here is owed to nobody.
  for (HandAccount& account : accounts_)
    account.keepOwed([&](std::uint64_t key) { return world().has(key) && goesOn(key, before); });
  view_ = before.view_;
  view_.bodies = bodies_.size();
  time_ns_ = before.time_ns_;
  begun_ = before.begun_;
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
  out.owed = accounts_[0].owed();
  out.drawn = accounts_[0].drawn();
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
  accounts_[0].resume(memory.owed, memory.drawn);
  pushes_ = memory.pushes;
  time_ns_ = memory.time_ns;
  begun_ = memory.begun;
}

void BodyWorld::set(std::size_t i, const Vec3& velocity, const Vec3& spin) {
  wake(world(), state_, world().bodies[i].key);
  state_.bodies[i].velocity = velocity;
  state_.bodies[i].spin = spin;
}

double BodyWorld::energy_J() const {
  return kineticEnergy_J(world(), state_) + gravityEnergy_J(world(), state_) + springEnergy_J(world(), state_);
}

void BodyWorld::act(const BodyCommands& commands) {
  for (const BodyCommand& command : commands) hl::act(moving(), command, pushes_);
}

void BodyWorld::draw(std::size_t hand, const FieldForces& fields, double period_s) {
  accounts_[hand].draw(world(), fields, period_s);
}

void BodyWorld::settle(std::size_t hand, const ObjectForces& forces, double period_s) {
  for (const BodyImpulse& one : accounts_[hand].settle(world(), forces, period_s)) giveByHand(moving(), one);
}

// In whole, before the step: so a body swings about a field as by symplectic Euler.
void BodyWorld::payDrawn() {
  for (HandAccount& account : accounts_) {
    for (const BodyImpulse& one : account.takeDrawn()) giveByHand(moving(), one);
  }
}

// The bodies and the hands that pull, or have something to pay.
void BodyWorld::stepAmong(std::span<const HandAtBodies> hands, double period_s, const StepTimes& times) {
  FixedVector<HandNode, kMaxHands> nodes;
  FixedVector<HandAccount*, kMaxHands> of_node;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    HandAccount& account = accounts_[i];
    if (!(hands[i].spring_N_m > 0) && account.owed().empty()) continue;
    nodes.push(nodeOf(hands[i], account.owed()));
    of_node.push(&account);
  }
  std::array<GivenImpulses, kMaxHands> given;
  report_ = stepper_.step(state_, period_s, {nodes.begin(), nodes.size()}, {given.data(), nodes.size()}, times);
  for (std::size_t i = 0; i < nodes.size(); ++i) of_node[i]->pay(given[i]);
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
  for (HandAccount& account : accounts_) account.beginStep();
  if (!std::exchange(mobility_shown_, true)) showMobility();
  if (first || now_ns <= before_ns) return;
  if (lost_.findNotFinite(moving()) != LostBodies::Kind::kNone) putBackLost();
  push(moving(), pushes_, period_s);
  payDrawn();
  const EnergyBook before = state_.energy;
  stepAmong(hands, period_s, {before_ns, now_ns});
  for (const std::size_t i : stepper_.awake()) bodies_[i]->poses->moveTo(moving().shown(i), before_ns, now_ns);
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

// `before`: what was booked before the step. What a step has lost or given that comes to no finite state is not known.
void BodyWorld::returnLost(const EnergyBook& before) {
  const LostBodies::Kind worst = lost_.find(moving());
  if (worst == LostBodies::Kind::kNone) return;
  if (worst == LostBodies::Kind::kNotFinite) forgetStep(before);
  const double before_J = energy_J();
  putBackLost();
  if (worst == LostBodies::Kind::kOutside) state_.energy.solver_J += energy_J() - before_J;
}

// The next step must not begin from what is not finite.
void BodyWorld::forgetStep(const EnergyBook& before) {
  state_.energy = before;
  state_.memory.clear();
  for (HandAccount& account : accounts_) account.forgetOwed();
}

void BodyWorld::putBackLost() { view_.returned += lost_.putBack(moving(), stepper_.groups()); }

Vec3 BodyWorld::owed_N_s() const {
  Vec3 sum = Vec3::Zero();
  for (const HandAccount& account : accounts_) sum += account.sum_N_s();
  return sum;
}

}  // namespace hl
