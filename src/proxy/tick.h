// One tick's work: feasible sequential convex steps toward the finger.
//
//   minimise 1/2 |x - finger|^2 over the places x clear of the scene
//
// Each step linearises the obstacles in touch (constraints.h), solves the convex subproblem that they make, or what the
// rules of the surfaces make of it (surface_rules.h), pays for what it may add to the spring's energy
// (energy_booking.h) and goes until it meets something new (walk.h). A second-order step (curvature_step.h) is on trial
// (trial.h); progress.h and the length of the step say when the tick has come to its end, work.h when it has done
// enough. Every place on the way is valid, so the tick may end anywhere.
#pragma once

#include "proxy/constraints.h"
#include "proxy/energy_booking.h"
#include "proxy/goal.h"
#include "proxy/progress.h"
#include "proxy/proposal.h"
#include "proxy/proxy_state.h"
#include "proxy/surface_rules.h"
#include "proxy/tick_input.h"
#include "proxy/tick_report.h"
#include "proxy/trial.h"
#include "proxy/walk.h"
#include "proxy/work.h"

namespace hl {

/// RT-safe.
class Tick {
 public:
  Tick(const SceneAt& scene, const ProxySettings& settings, ProxyState& state, const Vec3& finger, int most_looks);

  TickReport run();

 private:
  void look();
  void lookAgain();
  void judgeTrial();
  void propose();
  void proposePlain();
  void proposeFelt();
  bool atRest() const { return input_.stationary(proposal_.step, state_.position); }
  void aimAt(const Vec3& place);
  Ending judge(int iterations) const;
  Ending endingOfRest() const;
  bool tryCurvedStep();
  void advance();
  bool ledByRounding(const Vec3& from) const;
  bool heldByCrowd(const Vec3& from) const;
  void settle(bool whole, const Vec3& step);
  void close(TickReport& report);

  const TickInput input_;
  ProxyState& state_;
  Goal goal_;
  EnergyBooking booking_;
  SurfaceRules rules_;
  Constraints constraints_;
  Walk walk_;
  Trial trial_;
  Progress progress_;
  Work work_;
  Proposal proposal_;                          // the step in hand
  FixedVector<ActiveContact, 3> last_active_;  // what has held the proxy last
};

}  // namespace hl
