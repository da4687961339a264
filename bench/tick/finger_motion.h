// The motions of the finger that are timed. It always moves at 0.15 m/s of the hand, sampled a thousand times a second;
// where it turns to depends on what the proxy touches, so a path is planned by moving a proxy along.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl::bench {

inline constexpr double kSpeed_m_s = 0.15;
inline constexpr double kPeriod_s = 1e-3;

enum class FingerMotion : std::uint8_t {
  kSliding,    ///< 4 mm beneath the proxy
  kFree,       ///< near the surface, never touching it
  kTapping,    ///< down until 4 mm beneath the proxy, up again, several times a second
  kCorners,    ///< 15 mm beneath the proxy, which so runs into every crease on its way
  kTracing,    ///< 0.5 to 3.5 mm beneath the surface, up and down with all its detail
  kWandering,  ///< to places of the surface drawn at random, 4 mm ahead of the proxy
};
inline constexpr std::array kFingerMotions{FingerMotion::kSliding, FingerMotion::kFree,    FingerMotion::kTapping,
                                           FingerMotion::kCorners, FingerMotion::kTracing, FingerMotion::kWandering};
/// "sliding", "free", "tapping", "corners", "tracing" or "wandering".
const char* nameOf(FingerMotion motion);

/// The finger, one place a tick, and where the proxy was after each. World frame.
struct Path {
  std::size_t approach = 0;   ///< ticks until the finger is at the surface; they are not timed
  std::vector<Vec3> fingers;  ///< fingers[0] is where the proxy starts
  std::vector<Vec3> proxies;
};

/// `ticks` of them after the approach, with the proxy of `settings`; all that the finger does is magnified by
/// `world_per_hand`. The same arguments give the same path.
Path planPath(const Snapshot& snapshot, FingerMotion motion, const ProxySettings& settings, std::size_t ticks,
              double world_per_hand = 1);

}  // namespace hl::bench
