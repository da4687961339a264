#include "proxy/goal_tick.h"

#include "proxy/spring_energy.h"
#include "proxy/tolerances.h"

namespace hl {

TickReport notCounted(const TickReport& tried, Ending why) {
  TickReport report;
  report.ending = why;
  report.work = tried.work;
  report.looks = tried.looks;
  report.used_up_at = tried.used_up_at;
  return report;
}

TickReport tickToGoal(ProxyState& state, const ProxySettings& settings, const Vec3& finger, const GoalOfTick& goal,
                      TickTo tick_to) {
  ProxyState there = state;
  TickReport report = tick_to(goal.place, there, 0);
  const double added_J = springEnergy_J(settings, there, finger) - goal.before_J;
  const double budget_J = state.ledger.budget_J(settings.ledger);
  if (!(added_J <= budget_J + accuracy::kEnergyRounding * goal.before_J + accuracy::kEnergyRounding_J))
    return notCounted(report, Ending::kNoEnergy);
  there.ledger = state.ledger;
  there.ledger.book(added_J, true);
  state = there;
  report.injected_J = added_J;
  return report;
}

void setHeldPull(ProxyState& state, const Vec3& finger, const Vec3& pull_m, TickReport& report) {
  state.touching = true;
  report.target = finger + state.stiffness * (state.anchor() - finger);
  report.held_pull_m = pull_m;
}

}  // namespace hl
