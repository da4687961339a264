// What a tick came to: why it ended, where the servo pulls, and what holds the proxy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "scene/recent_primitives.h"

namespace hl {

/// A plane that holds the proxy at the end of a tick.
struct ProxyContact {
  Vec3 point;   ///< on the surface, nearest the proxy
  Vec3 normal;  ///< unit, from the surface to the proxy; the shading normal
  /// Its share of proxy - finger: sum multiplier_m * normal; times K s it is the normal force; below 0: it pulls.
  double multiplier_m;
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
  int looks = 0;         ///< at what is near the proxy
  int used_up_at = 0;    ///< looks after which its work was used up; 0: it was not
  Ending ending = Ending::kGoesOn;
  /// Ended before the local minimum, at a valid place.
  bool capped() const { return ending == Ending::kCapped; }
  bool placed() const { return ending != Ending::kUnplaced; }
  bool valid() const { return ending != Ending::kInvalid; }
};

}  // namespace hl
