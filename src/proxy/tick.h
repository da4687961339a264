// One tick: feasible sequential convex steps of the proxy toward the finger.
//
//   minimise 1/2 |x - finger|^2 over all positions x that are clear of the scene
//
// Each step linearises the obstacles in contact (constraints.h) and solves the resulting convex subproblem, modified by
// the rules of the surfaces (surface_rules.h). Steps that may raise the spring's energy are shortened to the energy
// budget (energy_booking.h). The proxy moves by the step or up to the first new impact (walk.h). Second-order steps
// (curvature_step.h) are made on trial (trial.h). The tick ends when the step is short enough, without more progress
// (progress.h), or at the work limit (work.h). Every position on the way is valid, so the tick may end anywhere.
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
  /// `loads`: of surfaces that adhere; read while the tick runs.
  Tick(const SceneAt& scene, const ProxySettings& settings, ProxyState& state, const Vec3& finger, int most_looks,
       const AdhesionLoads* loads = nullptr);

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
  Proposal proposal_;                                   // the current step
  FixedVector<ActiveContact, kMaxActive> last_active_;  // active contacts of the last step that had any
};

}  // namespace hl
