#include "bodies/motion_plan.h"

#include <algorithm>
#include <limits>

#include "bodies/row_solver.h"

namespace hl {

namespace {

// Of an overlap this part is removed in a step.
constexpr double kPushedApart = 0.2;
// m; a smaller overlap at the end of a step is left to pushApart().
constexpr double kLeft_m = 1e-5;
// How often all pairs are looked at; each time what would pass goes a quarter of its part. Then it stays where it is,
// as that place was clear.
constexpr int kLooks = 8;
constexpr double kShorter = 0.25;

// m, how far the lowest vertex of `a` is above the highest of `b` along the normal, of the grown shapes.
double separationAlong(const PlacedConvex& a, const PlacedConvex& b, const Vec3& normal) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& vertex : a.vertices) low = std::min(low, normal.dot(vertex));
  for (const Vec3& vertex : b.vertices) high = std::max(high, normal.dot(vertex));
  return low - high - a.shape->radius - b.shape->radius;
}

}  // namespace

MotionPlan::MotionPlan(const BodyProblem& problem) : problem_(problem) {
  plan_.ways.resize(problem.bodies());
  plan_.turns.resize(problem.bodies());
  plan_.parts.resize(problem.bodies());
  apart_.reserve(problem.nodes.capacity());
  overlaps_.reserve(problem.rows.capacity());
}

void MotionPlan::make(const WorldState& state, double margin, bool converged) {
  goWithVelocities();
  pushApart();
  limit(margin);
  stopShort(state, converged);
}

// Without contact the path of a fall is a parabola: half of what gravity adds to the velocity has not acted on the way.
void MotionPlan::goWithVelocities() {
  const double period_s = problem_.period_s;
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    plan_.ways[i] = period_s * problem_.nodes[i].velocity - period_s * period_s / 2 * problem_.world->gravity_m_s2;
    plan_.turns[i] = problem_.nodes[i].spin;
    plan_.parts[i] = 1;
  }
  for (const Row& row : problem_.rows) {
    if (!(row.pressed > 0)) continue;
    for (const int number : {row.a, row.b}) {
      const auto i = static_cast<std::size_t>(number);
      if (number != Row::kFixed && i < problem_.bodies()) plan_.ways[i] = period_s * problem_.nodes[i].velocity;
    }
  }
}

// Overlaps are removed by velocities of their own, which act for this step alone and leave no kinetic energy.
void MotionPlan::pushApart() {
  overlaps_.clear();
  for (const Row& row : problem_.rows) {
    if (row.gap >= -kTouching_m) continue;
    overlaps_.push_back(row);
    overlaps_.back().pressed = overlaps_.back().friction = 0;
    overlaps_.back().dragged.setZero();
    overlaps_.back().carried.setZero();
    overlaps_.back().least_velocity = -kPushedApart * row.gap / problem_.period_s;
  }
  if (overlaps_.empty()) return;
  apart_ = problem_.nodes;
  for (Node& node : apart_) node.velocity = node.spin = Vec3::Zero();
  for (Row& row : overlaps_) prepareRow(row, apart_);
  solveRows(overlaps_, apart_, problem_.period_s, limitsFor(overlaps_.size()));
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    plan_.ways[i] += problem_.period_s * apart_[i].velocity;
    plan_.turns[i] += apart_[i].spin;
  }
}

void MotionPlan::limit(double margin) {
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    const double way = plan_.ways[i].norm() + problem_.period_s * plan_.turns[i].norm() * problem_.reachOf(i);
    if (way > margin / 2) plan_.parts[i] = margin / 2 / way;
  }
}

// m: how far the pair would end inside each other or, of what is fast, on another side.
double MotionPlan::depthAtEnd(const WorldState& state, const Meeting& meeting) const {
  Manifold end;
  const double overlap = problem_.meetsAtEnd(state, meeting, plan_, end) ? deepestOf(end) : 0;
  if (!paceOf(problem_, meeting).fast) return overlap;
  PlacedRoom room_a, room_b;
  const PlacedConvex a = problem_.atEnd(state, static_cast<std::size_t>(meeting.a), plan_, room_a);
  const PlacedConvex b = problem_.otherAtEnd(state, meeting, plan_, room_b);
  return std::max(overlap, -separationAlong(a, b, meeting.manifold.normal));
}

// Farther than it began.
bool MotionPlan::passes(const WorldState& state, const Meeting& meeting) const {
  return depthAtEnd(state, meeting) > std::max(kLeft_m, deepestOf(meeting.manifold) + kTouching_m);
}

// Scenery that its client moves toward the body does not wait for it.
bool MotionPlan::comesToward(const Meeting& meeting) const {
  if (meeting.b != Row::kFixed) return false;
  const Vec3& centre = problem_.nodes[static_cast<std::size_t>(meeting.a)].centre;
  return problem_.sceneryVelocityAt(meeting.primitive, centre).dot(meeting.manifold.normal) > 0;
}

void MotionPlan::shorten(const WorldState& state, const Meeting& meeting) {
  constexpr int kTimes = 4;
  double& of_a = plan_.parts[static_cast<std::size_t>(meeting.a)];
  double& of_b = meeting.b == Row::kFixed ? of_a : plan_.parts[static_cast<std::size_t>(meeting.b)];
  const double part = of_a, depth = comesToward(meeting) ? depthAtEnd(state, meeting) : 0;
  for (int time = 0; time < kTimes; ++time) {
    of_a *= kShorter;
    if (&of_b != &of_a) of_b *= kShorter;
    if (!passes(state, meeting)) return;
  }
  of_a = of_b = 0;
  if (depth > 0 && depthAtEnd(state, meeting) > depth) of_a = part;  // it is in the body all the more
}

void MotionPlan::stopShort(const WorldState& state, bool converged) {
  for (int look = 0; look < kLooks; ++look) {
    bool shortened = false;
    for (const Meeting& meeting : problem_.meetings.all()) {
      const Pace pace = paceOf(problem_, meeting);
      if (converged && look == 0 && !pace.fast && !pace.turns) continue;
      if (!passes(state, meeting)) continue;
      shortened = true;
      if (look + 1 < kLooks || comesToward(meeting)) {
        shorten(state, meeting);
      } else {
        plan_.parts[static_cast<std::size_t>(meeting.a)] = 0;
        if (meeting.b != Row::kFixed) plan_.parts[static_cast<std::size_t>(meeting.b)] = 0;
      }
    }
    if (!shortened) return;
  }
}

}  // namespace hl
