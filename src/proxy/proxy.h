// The proxy (the paper's section 3): a sphere that follows the finger by direct linear motion and never enters an
// object. A pure function of (state, snapshot, finger): no threads, devices or clocks.
//
// One tick repeats: gather the primitives in contact; each is convex, so the half-space above its tangent plane in
// configuration space is free of it. Solve for the sub-goal nearest the finger above all of these planes, sweep the
// sphere toward it past all *other* primitives, and stop at the first impact. The split is exact: a primitive is either
// a contact (a plane holds it off) or swept, never both and never neither, by one comparison with one distance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/fixed_vector.h"
#include "base/ledger.h"
#include "base/vec.h"
#include "proxy/proxy_cache.h"
#include "proxy/start_search.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// How often the two passes of force shading run.
enum class ShadingPasses : std::uint8_t {
  kConverged,  ///< to the fixed point: finger - proxy along the shaded normal where the proxy is
  kOnce,       ///< once a tick, as the paper does; the fixed point is approached over the next ticks
};

/// A work_cap, or a number of looks, that no tick comes to.
inline constexpr int kNoWorkCap = std::numeric_limits<int>::max();

struct ProxySettings {
  double radius = 0.001;        ///< m, > 0
  int iteration_cap = 1000;     ///< a tick that needs more steps stops where it is, at a valid position
  int work_cap = 9'000;         ///< the same of one that does more than this (work.h): some 50 us
  double spring_N_m = 1000;     ///< K of the servo, at the hand: scales viscosity and the ledger
  double period_s = 1e-3;       ///< T, one tick: scales viscosity
  double world_per_device = 1;  ///< metres of the scene for one of the hand: scales the ledger
  ShadingPasses shading = ShadingPasses::kConverged;
  LedgerMode ledger = LedgerMode::kTank;
  MaterialOverride surfaces{};  ///< set by the user over what the scene says
};

/// World frame. Owned by the proxy loop.
struct ProxyState {
  Vec3 position = Vec3::Zero();        ///< centre of the sphere
  bool free = false;                   ///< false while no place clear of the scene has been found near the finger
  bool touching = false;               ///< the last tick ended in contact, or on its way from one to the next
  double rest_s = accuracy::kStuck_s;  ///< since it last slipped along a surface; from kStuck_s on it sticks
  Vec3 creep = Vec3::Zero();           ///< m, how far it has crept from where it stuck, on the pre-sliding springs
  double stiffness = 1;                ///< s by which the last tick's target was pulled; 1 in the open
  std::int64_t time_ns = 0;            ///< of the scene in the last tick
  std::uint64_t snapshot = 0;          ///< number of that scene; 0: none yet
  std::uint64_t carrier = 0;           ///< key of the object whose friction holds it; 0: none
  Ledger ledger{};
  StartSearch start{};  ///< while it is not free
  ProxyCache cache{};
};

/// A plane that holds the proxy at the end of a tick.
struct ProxyContact {
  Vec3 point;           ///< on the surface, nearest the proxy
  Vec3 normal;          ///< unit, from the surface to the proxy, bent by shading and bump
  double multiplier_m;  ///< its share of proxy - finger: sum multiplier_m * normal; times K it is the normal force
  PrimitiveId primitive;
  double stiffness;        ///< s of the surface here, 0..1
  double static_friction;  ///< mu_s
  bool rough;              ///< friction or viscosity act here
};

/// Why a tick ended.
enum class Ending : std::uint8_t {
  kGoesOn,      ///< it has not
  kReached,     ///< the proxy is at the finger: nothing is in the way
  kStationary,  ///< no step comes nearer: the local minimum
  kSettled,     ///< the same under the rules of the surfaces, found without another look
  kStalled,     ///< only steps that rounding leads are left
  kPostponed,   ///< what is left to slip is for the next tick
  kNoEnergy,    ///< the energy that it may add is used up
  kCrowded,     ///< more touches the proxy than there is room for, and lets it go no farther
  kCapped,      ///< the iteration cap
  kOutOfWork,   ///< it has done as much as one tick may (work.h): the next goes on from here
  kUnplaced,    ///< no place clear of the scene has been found near the finger: nothing pulls
  kInvalid,     ///< the finger was not finite or beyond kFarthestFinger_m: nothing has moved
};
inline constexpr std::size_t kEndings = 12;
inline constexpr std::array<const char*, kEndings> kEndingNames{"goes_on", "reached",     "stationary", "settled",
                                                                "stalled", "postponed",   "no_energy",  "crowded",
                                                                "capped",  "out_of_work", "unplaced",   "invalid"};
/// As metrics, states of the server and hl trace call it.
constexpr const char* nameOf(Ending ending) { return kEndingNames[static_cast<std::size_t>(ending)]; }

struct TickReport {
  FixedVector<ProxyContact, 3> contacts;
  Vec3 target = Vec3::Zero();  ///< where the servo pulls the finger: the proxy after stiffness
  double injected_J = 0;       ///< what the tick did to the spring's energy: added (positive) or dissipated (negative)
  double moved_J = 0;          ///< what moving objects did to it before
  int iterations = 0;
  std::size_t work = 0;  ///< what it has cost (work.h)
  int used_up_at = 0;    ///< looks after which its work was used up; 0: it was not
  Ending ending = Ending::kGoesOn;
  /// Ended before the local minimum, at a valid place.
  bool capped() const { return ending == Ending::kCapped; }
  bool placed() const { return ending != Ending::kUnplaced; }
  bool valid() const { return ending != Ending::kInvalid; }
};

/// A proxy at the finger or, when the finger touches the scene, at a clear place nearby, looked for at once wherever
/// there may be one: thousands of searches where there is none. A loop starts with ProxyState{} instead: each tick then
/// looks at a few places, until one is clear. Does not allocate.
ProxyState startProxy(const SceneAt& scene, const ProxySettings& settings, const Vec3& finger);

/// Moves the proxy, or one that is not free to a place where it can begin, toward the finger under the rules of the
/// surfaces it touches, and accounts for the energy. RT-safe. Afterwards |proxy - surface| >= radius. Without shading
/// and bump maps |proxy - finger| is not larger than before. `most_looks`, > 0: its work is used up after so many,
/// as that of the tick was which is made again.
TickReport tick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                int most_looks = kNoWorkCap);

}  // namespace hl
