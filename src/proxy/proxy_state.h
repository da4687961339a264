// The proxy's settings, and what a tick leaves for the next one.
#pragma once

#include <cstdint>
#include <limits>

#include "base/fixed_vector.h"
#include "base/ledger.h"
#include "base/vec.h"
#include "proxy/proxy_cache.h"
#include "proxy/start_search.h"
#include "proxy/tolerances.h"
#include "scene/material.h"

namespace hl {

/// How often the two passes of force shading run.
enum class ShadingPasses : std::uint8_t {
  kConverged,  ///< to the fixed point: finger - proxy along the shaded normal where the proxy is
  kOnce,       ///< once a tick, as the paper does; the fixed point is approached over the next ticks
};

/// A work_cap, or a number of looks, that no tick comes to.
inline constexpr int kNoWorkCap = std::numeric_limits<int>::max();

struct ProxySettings {
  double radius = 0.001;     ///< m, > 0
  int iteration_cap = 1000;  ///< a tick that needs more steps stops where it is, at a valid position
  int work_cap = 9'000;  ///< the same of one that does more than this (work.h): some 50 us. Many such ticks in a row
                         ///< may do 16 times it
  double spring_N_m = 1000;     ///< K of the servo, at the hand: scales viscosity and the ledger
  double period_s = 1e-3;       ///< T, one tick: scales viscosity
  double world_per_device = 1;  ///< metres of the scene for one of the hand: scales the ledger
  ShadingPasses shading = ShadingPasses::kConverged;
  LedgerMode ledger = LedgerMode::kTank;
  MaterialOverride surfaces{};  ///< set by the user over what the scene says
};

/// A surface that keeps the proxy until it is pulled off by more than `adhesion_N` along `normal`.
struct AdheringContact {
  Vec3 normal;  ///< unit, from the surface to the proxy
  double adhesion_N;
};
using AdheringContacts = FixedVector<AdheringContact, 3>;

/// World frame. Owned by the proxy loop.
struct ProxyState {
  Vec3 position = Vec3::Zero();        ///< centre of the sphere
  bool free = false;                   ///< false while no place clear of the scene has been found near the finger
  bool touching = false;               ///< the last tick ended in contact, or on its way from one to the next
  double rest_s = accuracy::kStuck_s;  ///< since it last slipped along a surface; from kStuck_s on it sticks
  Vec3 presliding_m = Vec3::Zero();    ///< m, how far it has crept from where it stuck, on the pre-sliding springs
  double stiffness = 1;                ///< s by which the last tick's target was pulled; 1 in the open
  std::int64_t time_ns = 0;            ///< of the scene in the last tick
  std::uint64_t snapshot = 0;          ///< number of that scene; 0: none yet
  std::uint64_t carrier = 0;           ///< key of the object whose friction holds it; 0: none
  AdheringContacts adhering{};         ///< those of the last tick (adhesion.h)
  Ledger ledger{};
  int out_of_work = 0;  ///< ticks in a row that ended so: more of them may do more (mostWork in tick.cpp)
  StartSearch start{};  ///< while it is not free
  ProxyCache cache{};
};

}  // namespace hl
