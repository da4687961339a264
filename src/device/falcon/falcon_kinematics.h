// The Falcon's arm: three legs at 120 degrees that carry the tip in parallel (R. E. Stamper, "A Three Degree of Freedom
// Parallel Manipulator with Only Translational Degrees of Freedom", 1997; dimensions: libnifalcon/libnifalcon,
// include/falcon/core/FalconGeometry.h). The thigh of each leg turns on its motor's axis; the shin is a parallelogram.
// Frame F of the device: x to the right, y up, z toward the user, from the centre of its base. Pure functions, RT-safe.
#pragma once

#include "base/vec.h"

namespace hl {

/// Angles of the three thighs, rad, that put the tip at `tip_F`. False when it is out of reach.
bool falconAngles(const Vec3& tip_F, Vec3& angles);
/// d angles / d tip, one row for each leg, where falconAngles() gives `angles`.
Mat3 falconAngleRates(const Vec3& tip_F, const Vec3& angles);
/// The tip of these angles, found from `tip_F`, a place nearby. False, and nothing changed, when there is none.
bool falconTip(const Vec3& angles, Vec3& tip_F);
/// Torques of the thighs, Nm, that make `force_F` at the tip. False where the arm is singular.
bool falconTorques(const Vec3& tip_F, const Vec3& angles, const Vec3& force_F, Vec3& torques_Nm);

/// The middle of the workspace, where D has its origin.
inline const Vec3 kFalconCentre_F{0, 0, 0.125};

}  // namespace hl
