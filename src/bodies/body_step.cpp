#include "bodies/body_step.h"

#include <algorithm>
#include <cmath>

#include "bodies/free_motion.h"
#include "bodies/row_solver.h"
#include "bodies/sleep.h"

namespace hl {

namespace {

// How often rows are added for what the motion found would pass. What is left stops short (motion_plan.h).
constexpr int kRounds = 8;
// How often a step may wake islands and begin anew; one that is hit after that is hard as a wall for this step.
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

double energyOfNode_J(const BodyProblem& problem, std::size_t body) {
  const Node& node = problem.nodes[body];
  const Mass& mass = problem.world->bodies[body].mass;
  const Vec3 spin = problem.turned[body].transpose() * node.spin;
  return (mass.mass_kg * node.velocity.squaredNorm() + spin.dot(mass.inertia_kg_m2 * spin)) / 2;
}

}  // namespace

// What sleeps is a node that nothing moves.
void BodyStepper::begin(const WorldState& state, double period_s) {
  problem_.period_s = period_s;
  problem_.nodes.resize(problem_.bodies());
  problem_.rows.clear();
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

// m/s: no body is faster after a hand that may meet it in this step has stopped at it.
double BodyStepper::fastestPushed_m_s(const HandNode& hand) const {
  double fastest = 0;
  const double reach = hand.stretch.norm(), impulse_N_s = hand.spring_N_m * problem_.period_s * reach;
  for (const std::size_t i : problem_.awake) {
    const Node& node = problem_.nodes[i];
    const double near = problem_.reachOf(i) + hand.radius_m + 2 * reach;
    if ((node.centre - hand.proxy).squaredNorm() > near * near) continue;
    const double square = problem_.reachOf(i) * problem_.reachOf(i);
    fastest = std::max(fastest, impulse_N_s * (node.inverse_mass + square * node.inverse_inertia.trace()));
  }
  return std::min(fastest, reach / problem_.period_s);
}

// Nothing moves farther in this step: twice the speed of the fastest, for one that is hit, and two that meet. A hand
// that is far beyond a surface counts by what it does to bodies.
double BodyStepper::margin(std::span<const HandNode> hands) const {
  double fastest = 0;
  for (const std::size_t i : problem_.awake)
    fastest =
        std::max(fastest, problem_.nodes[i].velocity.norm() + problem_.nodes[i].spin.norm() * problem_.reachOf(i));
  for (const HandNode& hand : hands) fastest = std::max(fastest, fastestPushed_m_s(hand));
  if (sceneryMoves()) fastest = std::max(fastest, fastest_scenery_m_s_);
  return 4 * problem_.period_s * (fastest + joints_.speed()) + kTouching_m;
}

void BodyStepper::solve(BodyStepReport& report) {
  int sweeps = 0;
  report.converged = solver_.solve(problem_, sweeps);
  report.sweeps = std::max(report.sweeps, sweeps);
}

void BodyStepper::bounce(BodyStepReport& report) {
  if (!impacts_.find(problem_.rows)) return;
  solve(report);
  for (int time = 1; time <= kWeakerTimes && impacts_.weaken(problem_.rows, time == kWeakerTimes); ++time)
    solve(report);
}

// What bears the hand and does not move is told as one, with key 0.
void BodyStepper::tellHands(std::span<GivenImpulses> given) const {
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

// The part of their velocity that a group of joined bodies keeps which goes a part of its way only. Gravity gives no
// energy for a way that was not gone. A group that stops short again and again is held in a way that the rows do not
// see: it loses velocity as it does way.
double BodyStepper::keptBy(std::uint32_t group, double part, int stopped_short) const {
  if (stopped_short > 1) return part;
  double kinetic_J = 0, not_fallen_J = 0;
  for (const std::size_t i : problem_.awake) {
    if (problem_.groups[i] != group) continue;
    kinetic_J += energyOfNode_J(problem_, i);
    const Vec3 not_gone = (1 - part) * plan_.ways().ways[i];
    not_fallen_J += world().bodies[i].mass.mass_kg * world().gravity_m_s2.dot(not_gone);
  }
  return not_fallen_J > 0 ? std::sqrt(std::max(0.0, 1 - not_fallen_J / kinetic_J)) : 1;
}

void BodyStepper::slowHeld(WorldState& state) {
  for (const std::size_t i : problem_.awake) {
    const double part = plan_.ways().parts[i];
    int& stopped_short = state.bodies[i].stopped_short;
    stopped_short = part < 1 ? stopped_short + 1 : 0;
    if (stopped_short == 0) continue;
    // The first of a group, which is slowed at once.
    if (problem_.groups[i] == i) kept_[i] = keptBy(problem_.groups[i], part, stopped_short);
    const double kept = kept_[problem_.groups[i]];
    Node& node = problem_.nodes[i];
    state.energy.contact_J += (1 - kept * kept) * energyOfNode_J(problem_, i);
    node.velocity *= kept;
    node.spin *= kept;
  }
}

// The angular momentum after the impulses stays; the turn is that of the spin before bounces.
void BodyStepper::move(WorldState& state) const {
  for (const std::size_t i : problem_.awake) {
    const Body& body = world().bodies[i];
    const Node& node = problem_.nodes[i];
    BodyState& one = state.bodies[i];
    const Vec3 momentum = inertiaOf(body, one) * node.spin;
    one.velocity = node.velocity;
    one.spin = plan_.ways().turns[i];
    moveFreely(body, one, plan_.wayOf(i), plan_.ways().parts[i] * problem_.period_s);
    one.spin = inverseInertia(body, one) * momentum;
    state.energy.solver_J += momentum.dot(one.spin - node.spin) / 2;
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

// The impulses of a step. `margin_m`: how far anything may go in it.
BodyStepReport BodyStepper::findImpulses(WorldState& state, double period_s, double& margin_m,
                                         std::span<const HandNode> hands, std::span<GivenImpulses> given) {
  BodyStepReport report;
  begin(state, period_s);
  state.memory.release();
  solver_.begin();
  for (std::size_t hand = 0; hand < hands.size(); ++hand) addHand(hands[hand], given[hand]);
  problem_.unpushed = problem_.nodes;
  impacts_.begin();
  joints_.begin(state);
  margin_m = margin(hands);
  for (std::size_t hand = 0; hand < hands.size(); ++hand)
    hand_rows_.add(hands[hand], hand, margin_m + hands[hand].stretch.norm(), state.memory);
  problem_.meetings.find(state, problem_.placed, margin_m);
  contacts_.addBearing(state.memory);
  for (Row& row : problem_.rows) prepareRow(row, problem_.nodes);
  solve(report);
  for (int round = 0; round < kBends && joints_.bend(state); ++round) solve(report);
  for (int round = 0; round < kBends && joints_.refuse(state); ++round) solve(report);
  for (int round = 0; round < kRounds && contacts_.addPassed(state); ++round) solve(report);
  return report;
}

// A step that would push what sleeps wakes it, and begins anew.
BodyStepReport BodyStepper::step(WorldState& state, double period_s, std::span<const HandNode> hands,
                                 std::span<GivenImpulses> given, const StepTimes& times) {
  double margin_m = 0;
  problem_.times = times;
  problem_.meetings.look(times.begin_ns);
  wakeFromOutside(state, hands);
  limitSpeeds(world(), state);
  BodyStepReport report = findImpulses(state, period_s, margin_m, hands, given);
  for (int time = 0; time < kRestarts && wakePushed(problem_, state); ++time)
    report = findImpulses(state, period_s, margin_m, hands, given);
  plan_.make(state, margin_m, report.converged);
  bounce(report);
  tellHands(given);
  book(state.energy, given);
  joints_.book(state);
  slowHeld(state);
  move(state);
  joints_.remember(state);
  contacts_.remember(state.memory);
  fallAsleep(problem_, islands_, state);
  ++state.steps;
  report.rows = static_cast<int>(problem_.rows.size());
  report.dropped = problem_.meetings.dropped();
  report.awake = static_cast<int>(problem_.awake.size());
  for (const Row& row : problem_.rows) report.deepest = std::max(report.deepest, -row.gap);
  return report;
}

}  // namespace hl
