#include "bodies/body_problem.h"

#include <algorithm>
#include <utility>

#include "bodies/joint_groups.h"

namespace hl {

namespace {

// Where a pair moves by more than this part of its size in a step, an end pose does not show what it passed.
constexpr double kFast = 0.1;
// rad; a body that turns by less in a step goes straight: what the turn bends is 5e-7 of its size.
constexpr double kStraight_rad = 1e-3;

std::shared_ptr<const World> checked(std::shared_ptr<const World> world) {
  checkWorld(*world);
  return world;
}

}  // namespace

BodyProblem::BodyProblem(std::shared_ptr<const World> of)
    : world(checked(std::move(of))), placed(*world), meetings(*world), joints(*world) {
  groups = jointGroups(*world);
  axes.reserve(bodies());
  for (const Body& body : world->bodies) axes.push_back(principalAxesOf(body.mass));
  awake.reserve(bodies());
  awake_joints.reserve(world->joints.size());
  turned.resize(bodies());
  nodes.reserve(bodies() + kMaxHands);
  before.reserve(bodies() + kMaxHands);
  unpushed.reserve(bodies() + kMaxHands);
  rows.reserve(mostRows(*world));
}

int BodyProblem::numberOf(std::uint64_t key) const { return nodeOf(*world, key); }

BodyState BodyProblem::stateAtEnd(const WorldState& state, std::size_t body, const BodyWays& plan) const {
  if (state.bodies[body].island != 0) return state.bodies[body];
  BodyState moved = state.bodies[body];
  moved.spin = plan.turns[body];
  moveFreely(axes[body], moved, plan.parts[body] * plan.ways[body], plan.parts[body] * period_s);
  return moved;
}

Pose BodyProblem::poseAtEnd(const WorldState& state, std::size_t body, const BodyWays& plan) const {
  return poseOf(world->bodies[body], stateAtEnd(state, body, plan));
}

Pace paceOf(const BodyProblem& problem, const Meeting& meeting) {
  Pace pace;
  double size = 0, way = 0;
  for (const auto& [number, part] : {std::pair(meeting.a, meeting.part_a), std::pair(meeting.b, meeting.part_b)}) {
    if (number == Row::kFixed) continue;
    const auto i = static_cast<std::size_t>(number);
    const Compound& shape = problem.world->bodies[i].shape;
    const double reach = shape.parts[static_cast<std::size_t>(part)].reach;
    const double turn = problem.period_s * problem.nodes[i].spin.norm();
    size = size == 0 ? reach : std::min(size, reach);
    way += problem.period_s * problem.nodes[i].velocity.norm() + turn * shape.reach;
    pace.turns |= turn > kStraight_rad && !shape.isBall();
  }
  if (meeting.b == Row::kFixed) {
    const Vec3& centre = problem.nodes[static_cast<std::size_t>(meeting.a)].centre;
    way += problem.period_s * problem.sceneryVelocityAt(meeting.primitive, centre).norm();
  }
  pace.fast = way > kFast * size;
  return pace;
}

double wayPastEachOther(const BodyProblem& problem, const Meeting& meeting) {
  const Node& a = problem.nodes[static_cast<std::size_t>(meeting.a)];
  const bool fixed = meeting.b == Row::kFixed;
  const auto turn_of = [&](int body) {
    const auto i = static_cast<std::size_t>(body);
    return problem.nodes[i].spin.norm() * problem.reachOf(i);
  };
  const Vec3 other = fixed ? problem.sceneryVelocityAt(meeting.primitive, a.centre)
                           : problem.nodes[static_cast<std::size_t>(meeting.b)].velocity;
  const double turns = turn_of(meeting.a) + (fixed ? 0 : turn_of(meeting.b));
  return problem.period_s * ((a.velocity - other).norm() + turns);
}

double deepestOf(const Manifold& manifold) {
  double deepest = 0;
  for (const ManifoldPoint& point : manifold.points) deepest = std::max(deepest, -point.gap);
  return deepest;
}

}  // namespace hl
