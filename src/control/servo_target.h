// ServoTarget: where the servo pulls the device, by the proxy.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace hl {

/// Where the servo pulls the finger: to target = finger + stiffness (proxy - finger), with the finger as it is at each
/// step. Device frame.
struct ServoTarget {
  Vec3 proxy_D = Vec3::Zero();
  std::int64_t time_ns = 0;     ///< when it was computed, on the clock of the samples
  bool valid = false;           ///< false: there is nothing to pull to; zero force, no fault
  double stiffness = 1;         ///< s of the surface, 0..1
  double paid_J = 0;            ///< energy that computing it has added, paid by the proxy's ledger
  Vec3 field_N = Vec3::Zero();  ///< of the scene's fields, also where nothing is to be pulled to; axes of the device
  double field_drag_Ns_m = 0;   ///< theirs, on the hand
};

/// Seconds from `then` to `now`, in double: times from a broken device cannot overflow.
inline double age_s(std::int64_t now_ns, std::int64_t then_ns) {
  return 1e-9 * (static_cast<double>(now_ns) - static_cast<double>(then_ns));
}

}  // namespace hl
