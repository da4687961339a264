#include "bodies/end_places.h"

#include <cmath>

#include "bodies/body_problem.h"

namespace hl {

EndPlaces::EndPlaces(const World& world) : placed_(world) {
  const Vec3 none = Vec3::Constant(NAN);
  courses_.assign(world.bodies.size(), {none, none, none, Eigen::Quaterniond::Identity()});
}

std::span<const PlacedConvex> EndPlaces::of(const BodyProblem& problem, const WorldState& state, std::size_t body,
                                            const BodyWays& plan) {
  const BodyState& begin = state.bodies[body];
  if (begin.island != 0) return problem.placed[body];
  const Course course{begin.centre, plan.ways[body],  plan.turns[body],
                      begin.turned, plan.parts[body], problem.period_s};
  if (!(course == courses_[body])) {
    courses_[body] = course;
    placed_.place(problem.world->bodies[body], body, problem.stateAtEnd(state, body, plan));
  }
  return placed_[body];
}

}  // namespace hl
