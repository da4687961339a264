// Effects: forces that the servo itself makes, besides the spring to the proxy: what holds up the device and a tool on
// it, drag of the open, a spring to a place, a constant force. Pure functions; RT-safe.
#pragma once

#include "base/vec.h"
#include "device/device.h"

namespace hl {

struct Effects {
  double tool_mass_kg = 0;       ///< mounted at the tip, held up against gravity
  double free_damping_Ns_m = 0;  ///< drag where nothing is touched
  double spring_N_m = 0;         ///< pulls the finger to spring_D
  Vec3 spring_D = Vec3::Zero();
  Vec3 constant_N = Vec3::Zero();
};

/// Their sum at the finger. `touching`: the spring to the proxy pulls. Device frame: y is up.
Vec3 effectForce(const Effects& effects, const DeviceSample& sample, const Vec3& velocity_m_s, bool touching);

}  // namespace hl
