// Goal tick: a tick to a goal in the place of the finger, because something that is no contact holds the proxy there: a
// snap, or matter. The spring still pulls toward the finger, and its energy is booked for the finger.
#pragma once

#include "base/function_ref.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"

namespace hl {

/// A tick to a goal, m, world, after `looks` looks of an earlier attempt.
using TickTo = FunctionRef<TickReport(const Vec3& goal, ProxyState& state, int looks)>;

/// Of a tick that was tried and does not count: the proxy has not moved, but the work is done.
TickReport notCounted(const TickReport& tried, Ending why);

/// What a tick aims at, world, and the energy of the spring to the finger before it, J.
struct GoalOfTick {
  Vec3 place;
  double before_J;
};

/// Makes the tick and books what it adds to the energy of the spring. One that adds more than the ledger's budget does
/// not count: nothing changes, and its ending is kNoEnergy. RT-safe.
TickReport tickToGoal(ProxyState& state, const ProxySettings& settings, const Vec3& finger, const GoalOfTick& goal,
                      TickTo tick_to);

/// After such a tick: the servo pulls the finger to the anchor of the spring, of which contacts do not hold `pull_m`.
/// RT-safe.
void setHeldPull(ProxyState& state, const Vec3& finger, const Vec3& pull_m, TickReport& report);

}  // namespace hl
