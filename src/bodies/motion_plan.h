// Motion plan: how far each body goes in a step. What the rows could not keep apart, since they are linear and the
// solver has an end, stops short: a body that would end inside another, or beyond it, goes a part of its way only. Its
// velocity stays, so that the next step has the impact.
#pragma once

#include <span>
#include <tuple>

#include "bodies/end_places.h"
#include "bodies/motion_bounds.h"
#include "bodies/pair_at_end.h"
#include "bodies/row_solver.h"
#include "bodies/step_work.h"

namespace hl {

/// By one thread at a time.
class MotionPlan {
 public:
  MotionPlan(const BodyProblem& problem, const JointRows& joints, const MotionBounds& bounds);

  /// From the solved velocities; nothing goes farther than the bounds. `converged`: of the solver. RT-safe.
  void make(const WorldState& state, bool converged);
  const BodyWays& ways() const { return plan_; }
  /// Two bodies that stopped short since they would have ended inside each other; of some pairs more than once.
  struct Stop {
    int a = 0, b = 0;  ///< numbers of bodies; b is Row::kFixed for the scene
  };
  std::span<const Stop> stops() const { return stops_; }
  /// Whole other ways for some bodies: `is_of(body)` says which, `way_of(body)` the way, m, and the turn, rad/s. False,
  /// and nothing is changed, if one would then end in something else, or farther off than the bounds. RT-safe.
  template <typename IsOf, typename WayOf>
  bool goOtherwise(const WorldState& state, const IsOf& is_of, const WayOf& way_of);
  /// m, of the way that the bodies go.
  Vec3 wayOf(std::size_t body) const { return plan_.parts[body] * plan_.ways[body]; }

 private:
  void goWithVelocities();
  void findOverlaps();
  void correct(const WorldState& state);
  void pushApart();
  bool pressesDeeper() const;
  void goApart(double most);
  void goPart(std::size_t body, double part);
  void goPart(const Meeting& meeting, double part);
  void limit();
  double farthestOf(std::size_t body) const;
  void stopShort(const WorldState& state, bool converged);
  double depthAtEnd(const WorldState& state, const Meeting& meeting, double enough);
  double depthOf(const PairAtEnd& pair, const Meeting& meeting, double enough) const;
  bool turnsApart(const PairAtEnd& pair, const Meeting& meeting) const;
  bool passes(const WorldState& state, const Meeting& meeting);
  bool comesToward(const Meeting& meeting) const;
  void shorten(const WorldState& state, const Meeting& meeting);
  void beginLooks();
  bool isClear(std::size_t meeting) const;

  const BodyProblem& problem_;
  const JointRows& joints_;
  const MotionBounds& bounds_;
  BodyWays plan_, last_plan_;
  EndPlaces ends_;
  // Changes of parts are counted. Of each body the last of its own; of each meeting the last before a look found that
  // the pair does not pass, or kNeverClear.
  std::vector<int> changed_, clear_;
  int changes_ = 0;
  std::vector<double> kept_;  // parts before something was shortened
  std::vector<Stop> stops_;
  std::vector<Node> apart_;  // velocities that only push overlapping bodies apart
  std::vector<Row> overlaps_;
  JointSet joints_apart_;
  RowSolver sweeps_;
  StepWork work_;
};

template <typename IsOf, typename WayOf>
bool MotionPlan::goOtherwise(const WorldState& state, const IsOf& is_of, const WayOf& way_of) {
  last_plan_ = plan_;
  bool goes = true;
  for (const std::size_t i : problem_.awake) {
    if (!is_of(i)) continue;
    std::tie(plan_.ways[i], plan_.turns[i]) = way_of(i);
    plan_.parts[i] = 1;
    goes &= farthestOf(i) <= bounds_.ways().bodies[i];
  }
  const auto counts = [&](int body) { return body != Row::kFixed && is_of(static_cast<std::size_t>(body)); };
  for (const Meeting& meeting : problem_.meetings.all()) {
    if (!goes) break;
    goes = counts(meeting.a) == counts(meeting.b) || !passes(state, meeting);
  }
  if (!goes) plan_ = last_plan_;
  return goes;
}

}  // namespace hl
