// Sleep: an island of bodies and joints that has been slower than 1 mm/s for half a second, and that no hand touches,
// is not stepped any more: its bodies and its joints stay as they are. It wakes as one: when a contact would push one
// of its bodies, when a hand owes one an impulse, when gravity changes, when scenery that moves is near, and by wake().
// A body that is asleep holds up what touches it without load.
#pragma once

#include "bodies/body_problem.h"
#include "bodies/islands.h"

namespace hl {

inline constexpr double kStill_m_s = 1e-3, kFallsAsleep_s = 0.5;

/// Wakes the body with this key, and all that sleep with it: to be called before what holds them is changed. RT-safe.
void wake(const World& world, WorldState& state, std::uint64_t key);
void wakeAll(WorldState& state);
/// Wakes what scenery may reach that its client moves during this step. RT-safe.
void wakeNearMoving(const World& world, WorldState& state, const StepTimes& times);
/// Whether of each joint both bodies sleep, or none. RT-safe.
bool sleepsWhole(const World& world, const WorldState& state);

/// Wakes what the rows push. False: nothing. RT-safe.
bool wakePushed(const BodyProblem& problem, WorldState& state);
/// After a step: counts, and lets islands fall asleep. The little kinetic energy that they have is booked as lost at
/// contacts. RT-safe.
void fallAsleep(const BodyProblem& problem, Islands& islands, WorldState& state);

}  // namespace hl
