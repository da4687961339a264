// Snapping: a point, line, curve or plane of an object that holds the proxy until it is pulled off.
//
// While a snap holds the proxy, the goal of the tick is not the finger but g, the point of the snap nearest to it. The
// tick goes there as it goes to a finger, so the proxy enters nothing, and friction and stiffness act as ever. Of the
// pull x - f (x the proxy, f the finger) the contacts hold x - g, and the snap g - f. It takes a free proxy when |g -
// f| <= min(capture, R), and lets go of it when |g - f| > R = release force / K: a spring that is taken in at r and
// given up at R has got K (r^2 - R^2) / 2 <= 0 from the snap (docs/snaps.md).
//
// A tick to g may raise the spring's energy 1/2 K s |x - f|^2, which is 0 while nothing holds the proxy: when the snap
// takes it, and where surfaces are in the way. That is paid by the tank (base/ledger.h): the goal is brought nearer
// until it can be, and a tick that has raised it by more does not count. What a release takes out of the spring goes
// back into the tank.
#pragma once

#include <optional>

#include "proxy/goal_tick.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// The point of the snap that holds the proxy, nearest to the finger; world frame. Absent: there is no such snap, or
/// none holds it. RT-safe.
std::optional<SnapPoint> heldPoint(const HeldSnap& held, const SceneAt& scene, const Vec3& finger);

/// Lets go of the snap that holds the proxy, or takes the proxy for the nearest one in reach, and returns its point
/// nearest to the finger; absent: none holds it. Of two that are as near, the first in the scene. RT-safe.
std::optional<Vec3> followSnap(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                               const Vec3& finger);

/// A tick of a proxy that the snap holds, or now takes, to its point `goal`. RT-safe; at most two ticks.
TickReport tickSnapped(ProxyState& state, const ProxySettings& settings, const Vec3& finger, const Vec3& goal,
                       TickTo tick_to);
/// The tick in which the snap has let go. RT-safe.
TickReport tickReleased(ProxyState& state, const Vec3& finger, TickTo tick_to);

}  // namespace hl
