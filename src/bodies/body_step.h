// Body step: moves all bodies of a world by one step of the servo. The hands are nodes of the same solve.
//
//   velocities after gravity -> rows for what bore load and for the hands -> rough impulses -> rows for what would be
//   passed through -> exact impulses -> plan of the motion -> bounces -> new poses
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bodies/contact_rows.h"
#include "bodies/hand_rows.h"
#include "bodies/held_bodies.h"
#include "bodies/impacts.h"
#include "bodies/island_solver.h"
#include "bodies/joint_rows.h"
#include "bodies/motion_bounds.h"
#include "bodies/motion_plan.h"

namespace hl {

struct BodyStepReport {
  int rows = 0;
  int awake = 0;            ///< bodies that were stepped
  int sweeps = 0;           ///< of the longest solve
  bool converged = true;    ///< false: a solve ended at its limit of work
  std::size_t dropped = 0;  ///< contacts without room
  double deepest = 0;       ///< m, greatest overlap at the begin of the step, >= 0
};

/// By one thread at a time.
class BodyStepper {
 public:
  explicit BodyStepper(std::shared_ptr<const World> world)
      : problem_(std::move(world)),
        unbounced_(problem_.bodies()),
        bounced_(problem_.bodies()),
        fastest_scenery_m_s_(problem_.world->fixed ? fastestScenery_m_s(*problem_.world->fixed) : 0) {}
  BodyStepper(const BodyStepper&) = delete;
  BodyStepper& operator=(const BodyStepper&) = delete;

  /// Moves `state` by `period_s` (> 0). `given`: room for each hand's impulses, of kMaxHands at most. `times`: the
  /// step among the motions of the scene. RT-safe.
  BodyStepReport step(WorldState& state, double period_s, std::span<const HandNode> hands,
                      std::span<GivenImpulses> given, const StepTimes& times = {});
  const World& world() const { return *problem_.world; }
  /// Numbers of the bodies that the last step moved, ascending.
  std::span<const std::size_t> awake() const { return problem_.awake; }
  /// Of each body: jointGroups().
  std::span<const std::uint32_t> groups() const { return problem_.groups; }
  /// Of the last step.
  std::span<const Row> rows() const { return problem_.rows; }

 private:
  bool sceneryMoves() const;
  void wakeFromOutside(WorldState& state, std::span<const HandNode> hands) const;
  BodyStepReport findImpulses(WorldState& state, double period_s, std::span<const HandNode> hands,
                              std::span<GivenImpulses> given);
  void begin(const WorldState& state, double period_s);
  void addHand(const HandNode& hand, GivenImpulses& given);
  void findMeetings(const WorldState& state, std::span<const HandNode> hands);
  void solve(BodyStepReport& report, Accuracy accuracy);
  void findRows(WorldState& state, BodyStepReport& report);
  bool addPassed(WorldState& state, Accuracy accuracy);
  void bounce(BodyStepReport& report);
  void collectGiven(std::span<GivenImpulses> given) const;
  void book(EnergyBook& energy, std::span<const GivenImpulses> given) const;
  void move(WorldState& state) const;

  BodyProblem problem_;
  ContactRows contacts_{problem_};
  JointRows joints_{problem_};
  MotionBounds bounds_{problem_, joints_};
  HandRows hand_rows_{problem_, contacts_, bounds_};
  MotionPlan plan_{problem_, joints_, bounds_};
  HeldBodies held_{problem_, plan_};
  Impacts impacts_{problem_};
  Islands islands_{problem_.nodes.capacity()};
  IslandSolver solver_{problem_};
  StepWork work_;
  std::vector<Vec3> unbounced_;  // spins before bounces
  std::vector<char> bounced_;    // of each body: its spin changed in the bounces of the step
  const double fastest_scenery_m_s_;
};

}  // namespace hl
