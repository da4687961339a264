#include "bodies/body_step.h"

#include <algorithm>
#include <cmath>

#include "bodies/row_solver.h"
#include "bodies/sleep.h"

namespace hl {

namespace {

// How often rows are added for what the motion found would pass: first by rough impulses, then by exact ones. What is
// left stops short (motion_plan.h).
constexpr int kRounds = 8;
// Updates of a row by a sweep, that a look at a meeting costs as much as.
constexpr int kUpdatesOfMeeting = 12;
// How often a step may wake islands and begin anew. One that is hit after that stays asleep in this step: it does not
// give way.
constexpr int kRestarts = 4;
// How often bounces are halved that would add energy; the last time there is none.
constexpr int kWeakerTimes = 4;
// How often the ways of joints are bent. What is left is straightened (motion_plan.h).
constexpr int kBends = 3;

void limitSpeeds(const World& world, WorldState& state) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    BodyState& body = state.bodies[i];
    const bool within = body.velocity.squaredNorm() <= kFastest_m_s * kFastest_m_s &&
                        body.spin.squaredNorm() <= kFastest_rad_s * kFastest_rad_s;
    if (within) continue;
    const double before_J = kineticEnergy_J(world.bodies[i], body);
    body.velocity = limited(body.velocity, kFastest_m_s);
    body.spin = limited(body.spin, kFastest_rad_s);
    state.energy.solver_J += kineticEnergy_J(world.bodies[i], body) - before_J;
  }
}

}  // namespace

// What sleeps is a node that nothing moves.
void BodyStepper::begin(const WorldState& state, double period_s) {
  problem_.period_s = period_s;
  problem_.step = state.steps;
  problem_.nodes.resize(problem_.bodies());
  problem_.rows.clear();
  problem_.dropped = 0;
  problem_.awake.clear();
  problem_.awake_joints.clear();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyState& body = state.bodies[i];
    Node& node = problem_.nodes[i];
    if (body.island == 0) {
      problem_.awake.push_back(i);
      problem_.turned[i] = body.turned.toRotationMatrix();
      node = {body.velocity, body.spin, 1 / world().bodies[i].mass.mass_kg, inverseInertia(world().bodies[i], body),
              body.centre};
    } else if (node.inverse_mass != 0 || node.centre != body.centre) {
      node = Node{};
      node.centre = body.centre;
    }
  }
  for (std::size_t i = 0; i < state.joints.size(); ++i) {
    const auto a = static_cast<std::size_t>(problem_.joints.blocks[i].a);
    if (state.bodies[a].island == 0) problem_.awake_joints.push_back(static_cast<std::uint32_t>(i));
  }
  problem_.before = problem_.nodes;
  for (const std::size_t i : problem_.awake) problem_.nodes[i].velocity += period_s * world().gravity_m_s2;
  problem_.placed.place(world(), state);
}

// Pays what is owed, and adds the hand's node. A light body would fly away with what it is owed, farther than the
// spring is long: it gets the part that the spring's own node, of mass K T^2, would leave it in an inelastic impact.
void BodyStepper::addHand(const HandNode& hand, GivenImpulses& given) {
  given.clear();
  const double node_kg = hand.spring_N_m * problem_.period_s * problem_.period_s;
  for (const BodyImpulse& owed : hand.owed) {
    const int body = problem_.numberOf(owed.key);
    if (body == Row::kFixed) continue;
    Node& node = problem_.nodes[static_cast<std::size_t>(body)];
    const Vec3 arm = owed.point - node.centre;
    BodyImpulse paid = owed;
    paid.impulse_N_s /= 1 + node_kg * node.mobilityAt(arm, owed.impulse_N_s);
    node.push(paid.impulse_N_s, arm);
    given.push(paid);
  }
  Node node;
  node.velocity = -hand.stretch / problem_.period_s;
  node.inverse_mass = 1 / node_kg;
  node.centre = hand.proxy;
  problem_.nodes.push_back(node);
  problem_.before.push_back(node);
}

// What overlaps goes apart though nothing is fast: in the room that this takes there may be more.
void BodyStepper::findMeetings(const WorldState& state, std::span<const HandNode> hands) {
  const auto find = [&] { problem_.meetings.find(state, problem_.placed, bounds_.near(), bounds_.ways()); };
  bounds_.find(state, hands, sceneryMoves() ? fastest_scenery_m_s_ : 0);
  find();
  if (bounds_.makeRoom(state, problem_.meetings.all())) find();
}

void BodyStepper::solve(BodyStepReport& report, Accuracy accuracy) {
  int sweeps = 0;
  report.converged = solver_.solve(problem_, accuracy, work_, sweeps);
  report.sweeps = std::max(report.sweeps, sweeps);
}

bool BodyStepper::addPassed(WorldState& state, Accuracy accuracy) {
  work_.spend(kUpdatesOfMeeting * static_cast<int>(problem_.meetings.all().size()));
  return contacts_.addPassed(state, accuracy);
}

// An impact at the foot of a stack takes a round for each of its bodies. Half of the work is left for exact impulses.
void BodyStepper::findRows(WorldState& state, BodyStepReport& report) {
  const auto has_work = [&] { return 2 * work_.left() > StepWork::kMax; };
  solve(report, Accuracy::kRough);
  for (int round = 0; round < kRounds && has_work() && addPassed(state, Accuracy::kRough); ++round)
    solve(report, Accuracy::kRough);
}

void BodyStepper::bounce(BodyStepReport& report) {
  std::fill(bounced_.begin(), bounced_.end(), 0);
  if (!impacts_.find(problem_.rows)) return;
  for (const std::size_t i : problem_.awake) unbounced_[i] = problem_.nodes[i].spin;
  solve(report, Accuracy::kExact);
  for (int time = 1; time <= kWeakerTimes && impacts_.weaken(problem_.rows, time == kWeakerTimes); ++time)
    solve(report, Accuracy::kExact);
  for (const std::size_t i : problem_.awake) bounced_[i] = problem_.nodes[i].spin != unbounced_[i] ? 1 : 0;
}

// What bears the hand and does not move is reported as one, with key 0.
void BodyStepper::collectGiven(std::span<GivenImpulses> given) const {
  for (std::size_t hand = 0; hand < given.size(); ++hand) {
    BodyImpulse fixed;
    for (const Row& row : problem_.rows) {
      if (static_cast<std::size_t>(row.a) != problem_.bodies() + hand || !(row.pressed > 0)) continue;
      const Vec3 impulse = -impulseOf(row);
      if (row.b == Row::kFixed) {
        fixed.impulse_N_s += impulse;
      } else {
        const auto b = static_cast<std::size_t>(row.b);
        given[hand].push({world().bodies[b].key, row.arm_b + problem_.nodes[b].centre, impulse});
      }
    }
    given[hand].push(fixed);
  }
}

void BodyStepper::book(EnergyBook& energy, std::span<const GivenImpulses> given) const {
  for (const Row& row : problem_.rows) {
    if (static_cast<std::size_t>(row.a) >= problem_.bodies()) continue;
    const Vec3 mean = (relativeVelocity(row, problem_.before) + relativeVelocity(row, problem_.nodes)) / 2;
    energy.contact_J -= row.pressed * row.normal.dot(mean);
    energy.friction_J -= row.dragged.dot(mean);
    energy.by_client_J += impulseOf(row).dot(row.carried);
  }
  for (const GivenImpulses& hand : given) {
    for (const BodyImpulse& one : hand) {
      const int number = problem_.numberOf(one.key);
      if (number == Row::kFixed) continue;
      const Node &now = problem_.nodes[static_cast<std::size_t>(number)],
                 &was = problem_.before[static_cast<std::size_t>(number)];
      const Vec3 arm = one.point - now.centre;
      energy.by_hand_J += one.impulse_N_s.dot(now.velocityAt(arm) + was.velocityAt(arm)) / 2;
    }
  }
  for (const std::size_t i : problem_.awake) {
    const Vec3 mean_way = problem_.period_s / 2 * (problem_.before[i].velocity + problem_.nodes[i].velocity);
    energy.solver_J += world().bodies[i].mass.mass_kg * world().gravity_m_s2.dot(mean_way - plan_.wayOf(i));
  }
}

// The turn is that of the spin before bounces. The angular momentum stays, but for a body that bounces: it is as if the
// bounce came at the end of the turn, at the same place of the body, so that its energy is the same there. That of the
// same momentum would not be: a needle has it along its thin axis as soon as it has turned a little.
void BodyStepper::move(WorldState& state) const {
  for (const std::size_t i : problem_.awake) {
    const Body& body = world().bodies[i];
    const Node& node = problem_.nodes[i];
    BodyState& one = state.bodies[i];
    const Vec3 momentum = inertiaOf(body, one) * node.spin;
    const Eigen::Quaterniond before = one.turned;
    one.velocity = node.velocity;
    one.spin = plan_.ways().turns[i];
    moveFreely(problem_.axes[i], one, plan_.wayOf(i), plan_.ways().parts[i] * problem_.period_s);
    if (bounced_[i] != 0) {
      one.spin = one.turned * (before.conjugate() * node.spin);
    } else {
      one.spin = inverseInertia(body, one) * momentum;
      state.energy.solver_J += momentum.dot(one.spin - node.spin) / 2;
    }
  }
}

bool BodyStepper::sceneryMoves() const {
  return world().fixed && problem_.times.begin_ns < world().fixed->moves_until_ns;
}

// What is owed to a sleeping body wakes it, and so does a change of gravity, and scenery that comes by.
void BodyStepper::wakeFromOutside(WorldState& state, std::span<const HandNode> hands) const {
  if (state.gravity_m_s2 != world().gravity_m_s2) wakeAll(state);
  state.gravity_m_s2 = world().gravity_m_s2;
  for (const HandNode& hand : hands) {
    for (const BodyImpulse& owed : hand.owed) {
      if (owed.impulse_N_s != Vec3::Zero()) wake(world(), state, owed.key);
    }
  }
  if (sceneryMoves()) wakeNearMoving(world(), state, problem_.times);
}

BodyStepReport BodyStepper::findImpulses(WorldState& state, double period_s, std::span<const HandNode> hands,
                                         std::span<GivenImpulses> given) {
  BodyStepReport report;
  begin(state, period_s);
  state.memory.release();
  work_.begin();
  for (std::size_t hand = 0; hand < hands.size(); ++hand) addHand(hands[hand], given[hand]);
  problem_.unpushed = problem_.nodes;
  impacts_.begin();
  joints_.begin(state);
  findMeetings(state, hands);
  for (std::size_t hand = 0; hand < hands.size(); ++hand) hand_rows_.add(hands[hand], hand, state.memory);
  contacts_.addBearing(state.memory);
  for (Row& row : problem_.rows) prepareRow(row, problem_.nodes);
  findRows(state, report);
  solve(report, Accuracy::kExact);
  for (int round = 0; round < kBends && joints_.bend(state); ++round) solve(report, Accuracy::kExact);
  for (int round = 0; round < kBends && joints_.refuse(state); ++round) solve(report, Accuracy::kExact);
  for (int round = 0; round < kRounds && work_.left() > 0 && addPassed(state, Accuracy::kExact); ++round)
    solve(report, Accuracy::kExact);
  return report;
}

// A step that would push what sleeps wakes it, and begins anew.
BodyStepReport BodyStepper::step(WorldState& state, double period_s, std::span<const HandNode> hands,
                                 std::span<GivenImpulses> given, const StepTimes& times) {
  problem_.times = times;
  problem_.meetings.look(times.begin_ns);
  wakeFromOutside(state, hands);
  limitSpeeds(world(), state);
  BodyStepReport report = findImpulses(state, period_s, hands, given);
  for (int time = 0; time < kRestarts && wakePushed(problem_, state); ++time)
    report = findImpulses(state, period_s, hands, given);
  plan_.make(state, report.converged);
  held_.plan(state);
  bounce(report);
  collectGiven(given);
  book(state.energy, given);
  joints_.book(state);
  held_.slow(state);
  move(state);
  joints_.remember(state);
  contacts_.remember(state.memory);
  fallAsleep(problem_, islands_, state);
  ++state.steps;
  report.rows = static_cast<int>(problem_.rows.size());
  report.dropped = problem_.meetings.dropped() + problem_.dropped;
  report.awake = static_cast<int>(problem_.awake.size());
  for (const Row& row : problem_.rows) report.deepest = std::max(report.deepest, -row.gap);
  return report;
}

}  // namespace hl
