#include "bodies/body_step.h"

#include <algorithm>

#include "bodies/free_motion.h"
#include "bodies/row_solver.h"

namespace hl {

namespace {

// m/s; slower impacts do not bounce, so that what rests comes to rest.
constexpr double kBounces_m_s = 0.02;
// How often rows are added for what the motion found would pass. What is left stops short (motion_plan.h).
constexpr int kRounds = 8;
// How often the ways of joints are bent. What is left is straightened (motion_plan.h).
constexpr int kBends = 3;

}  // namespace

void BodyStepper::begin(const WorldState& state, double period_s) {
  problem_.period_s = period_s;
  problem_.nodes.clear();
  problem_.rows.clear();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyState& body = state.bodies[i];
    problem_.turned[i] = body.turned.toRotationMatrix();
    problem_.nodes.push_back({body.velocity, body.spin, 1 / world().bodies[i].mass.mass_kg,
                              inverseInertia(world().bodies[i], body), body.centre});
  }
  problem_.before = problem_.nodes;
  for (Node& node : problem_.nodes) node.velocity += period_s * world().gravity_m_s2;
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

// Nothing moves farther in this step: twice the speed of the fastest, for one that is hit, and two that meet.
double BodyStepper::margin() const {
  double fastest = 0;
  for (std::size_t i = 0; i < problem_.nodes.size(); ++i) {
    const double reach = i < problem_.bodies() ? problem_.reachOf(i) : 0;
    fastest = std::max(fastest, problem_.nodes[i].velocity.norm() + problem_.nodes[i].spin.norm() * reach);
  }
  const bool moves = world().fixed && problem_.times.begin_ns < world().fixed->moves_until_ns;
  if (moves) fastest = std::max(fastest, fastest_scenery_m_s_);
  return 4 * problem_.period_s * (fastest + joints_.speed()) + kTouching_m;
}

void BodyStepper::solve(BodyStepReport& report) {
  const RowSolverLimits limits = limitsFor(problem_.rows.size() + 3 * problem_.joints.blocks.size());
  const int sweeps = solveRows(problem_.rows, problem_.joints, problem_.nodes, problem_.period_s, limits);
  report.sweeps = std::max(report.sweeps, sweeps);
  report.converged = sweeps < limits.sweeps;
}

void BodyStepper::bounce(BodyStepReport& report) {
  bool any = false;
  for (Row& row : problem_.rows) {
    if (!(row.pressed > 0) || row.restitution == 0 || row.approach > -kBounces_m_s) continue;
    row.least_velocity = -row.restitution * row.approach;
    any = true;
  }
  if (any) solve(report);
}

// What bears the hand and does not move is told as one, with key 0.
void BodyStepper::tellHands(std::span<GivenImpulses> given) const {
  for (std::size_t hand = 0; hand < given.size(); ++hand) {
    BodyImpulse fixed;
    for (const Row& row : problem_.rows) {
      if (static_cast<std::size_t>(row.a) != problem_.bodies() + hand || !(row.pressed > 0)) continue;
      const Vec3 impulse = -(row.pressed * row.normal + row.dragged);
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
    energy.by_client_J += (row.pressed * row.normal + row.dragged).dot(row.carried);
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
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    const Vec3 mean_way = problem_.period_s / 2 * (problem_.before[i].velocity + problem_.nodes[i].velocity);
    energy.solver_J += world().bodies[i].mass.mass_kg * world().gravity_m_s2.dot(mean_way - plan_.wayOf(i));
  }
}

// A body that stops short again and again is held in a way that the rows do not see: it loses velocity as it does way,
// or gravity would make it faster from step to step while it stays.
void BodyStepper::slowHeld(WorldState& state) {
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    const double part = plan_.ways().parts[i];
    int& stopped_short = state.bodies[i].stopped_short;
    stopped_short = part < 1 ? stopped_short + 1 : 0;
    if (stopped_short < 2) continue;
    Node& node = problem_.nodes[i];
    const Mat3 inertia = inertiaOf(world().bodies[i], state.bodies[i]);
    const double kinetic_J =
        (world().bodies[i].mass.mass_kg * node.velocity.squaredNorm() + node.spin.dot(inertia * node.spin)) / 2;
    state.energy.contact_J += (1 - part * part) * kinetic_J;
    node.velocity *= part;
    node.spin *= part;
  }
}

// The angular momentum after the impulses stays; the turn is that of the spin before bounces.
void BodyStepper::move(WorldState& state) const {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
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

BodyStepReport BodyStepper::step(WorldState& state, double period_s, std::span<const HandNode> hands,
                                 std::span<GivenImpulses> given, const StepTimes& times) {
  BodyStepReport report;
  problem_.times = times;
  problem_.meetings.look(times.begin_ns);
  begin(state, period_s);
  for (std::size_t hand = 0; hand < hands.size(); ++hand) addHand(hands[hand], given[hand]);
  joints_.begin(state);
  const double margin_m = margin();
  for (std::size_t hand = 0; hand < hands.size(); ++hand) hand_rows_.add(hands[hand], hand, margin_m, state.memory);
  problem_.meetings.find(world(), state, problem_.placed, margin_m);
  contacts_.addBearing(state.memory);
  for (Row& row : problem_.rows) prepareRow(row, problem_.nodes);
  solve(report);
  for (int round = 0; round < kBends && joints_.bend(state); ++round) solve(report);
  for (int round = 0; round < kBends && joints_.refuse(state); ++round) solve(report);
  for (int round = 0; round < kRounds && contacts_.addPassed(state); ++round) solve(report);
  plan_.make(state, margin_m, report.converged);
  bounce(report);
  tellHands(given);
  book(state.energy, given);
  joints_.book(state);
  slowHeld(state);
  move(state);
  joints_.remember(state);
  contacts_.remember(state.memory);
  ++state.steps;
  report.rows = static_cast<int>(problem_.rows.size());
  report.dropped = problem_.meetings.dropped();
  for (const Row& row : problem_.rows) report.deepest = std::max(report.deepest, -row.gap);
  return report;
}

}  // namespace hl
