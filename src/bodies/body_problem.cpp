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

struct PartOfBody {
  int body = 0, part = 0;
};

PlacedConvex partAtEnd(const BodyProblem& problem, const WorldState& state, const PartOfBody& of, const BodyWays& plan,
                       EndPlaces& ends) {
  return ends.of(problem, state, static_cast<std::size_t>(of.body), plan)[static_cast<std::size_t>(of.part)];
}

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

PlacedConvex BodyProblem::primitiveAtEnd(PrimitiveId primitive, PlacedRoom& room) const {
  const SceneAt& scene = *meetings.scene();
  return hl::placed(scene.primitive(primitive), scene.instance(primitive).poses().at(times.end_ns), room);
}

// A plane that has two convex shapes on its sides at both ends of a straight motion has them there all the way. Beside
// a triangle a body rolls on the next one, or over an edge: the plane must keep it as well as a contact would. A
// cylinder's points are given roughly beside a rim, its height above a plane exactly.
bool BodyProblem::isKeptApart(const Meeting& meeting, const PairAtEnd& end) const {
  if (meeting.b != Row::kFixed || end.b.vertices.size() != 3) return false;
  const PlacedConvex& a = placed[static_cast<std::size_t>(meeting.a)][static_cast<std::size_t>(meeting.part_a)];
  const Vec3& corner = end.b.vertices[0];
  Vec3 normal = (end.b.vertices[1] - corner).cross(end.b.vertices[2] - corner).normalized();
  if (normal.dot(a.centre - corner) < 0) normal = -normal;
  const bool is_plane = normal.squaredNorm() > 0;
  const double same = normal.dot(meeting.manifold.normal);
  const bool by_face = same >= kSameWay && !meeting.beside;
  if (!is_plane || (by_face && !isRound(end.a))) return false;
  const SceneAt& scene = *meetings.scene();
  PlacedRoom room;
  const PlacedConvex b = hl::placed(scene.primitive(meeting.primitive),
                                    scene.instance(meeting.primitive).poses().at(times.begin_ns), room);
  const double least = by_face ? -kTouching_m : meeting.beside ? -kHeld_m : -leftOf(a, b);
  return pairAlong(a, b, normal).gap >= least && pairAlong(end.a, end.b, normal).gap >= least;
}

PairAtEnd::PairAtEnd(const BodyProblem& problem, const WorldState& state, const Meeting& meeting, const BodyWays& plan,
                     EndPlaces& ends)
    : a(partAtEnd(problem, state, {meeting.a, meeting.part_a}, plan, ends)),
      b(meeting.b == Row::kFixed ? problem.primitiveAtEnd(meeting.primitive, room)
                                 : partAtEnd(problem, state, {meeting.b, meeting.part_b}, plan, ends)),
      along(pairAlong(a, b, meeting.manifold.normal)) {}

double overlapOf(const PairAtEnd& pair, Manifold& end) {
  end.points.clear();
  if (pair.along.hasPassed()) return std::max(-pair.along.gap, 0.0);
  return findManifold(pair.a, pair.b, 0, end) ? deepestOf(end) : 0;
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

double deepestOf(const Manifold& manifold) {
  double deepest = 0;
  for (const ManifoldPoint& point : manifold.points) deepest = std::max(deepest, -point.gap);
  return deepest;
}

}  // namespace hl
