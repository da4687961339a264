// Result of a tick: why it ended, the target of the servo, and the contacts that hold the proxy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/solver.h"
#include "scene/recent_primitives.h"

namespace hl {

/// A plane that is active at the end of a tick.
struct ProxyContact {
  Vec3 point;   ///< on the surface, nearest the proxy
  Vec3 normal;  ///< unit, from the surface to the proxy: the shading normal
  /// Multiplier: anchor of the spring - finger = sum multiplier_m * normal + held_pull_m. The anchor is the proxy,
  /// unless a surface yields (yielding.h). Times K s: the normal force. Negative: the surface pulls.
  double multiplier_m;
  PrimitiveId primitive;
  double stiffness;        ///< s of the surface at this point, 0..1
  double static_friction;  ///< mu_s
  /// It carries the proxy along the surface: friction or viscosity acts at this point, or the surface adheres.
  bool holds_tangentially;
  std::array<double, 3> weights{1, 0, 0};  ///< barycentric weights of `point` for the primitive's sorted vertices
};

/// Why a tick ended.
enum class Ending : std::uint8_t {
  kGoesOn,      ///< the tick has not ended
  kReached,     ///< the proxy is at the finger: nothing is in the way
  kStationary,  ///< local minimum: no step comes nearer
  kSettled,     ///< local minimum under the rules of the surfaces, found without gathering contacts again
  kStalled,     ///< only steps caused by rounding are left
  kPostponed,   ///< the rest of the slip is left to the next tick
  kNoEnergy,    ///< the energy budget of the tick is used up
  kCrowded,     ///< more contacts than the set can hold, and they stop the proxy
  kCapped,      ///< the iteration cap
  kOutOfWork,   ///< the work limit is reached (work.h); the next tick continues from this position
  kUnplaced,    ///< no position clear of the scene found near the finger: no force
  kInvalid,     ///< the finger was not finite or beyond kFarthestFinger_m: nothing has changed
};
inline constexpr std::size_t kEndings = static_cast<std::size_t>(Ending::kInvalid) + 1;
inline constexpr std::array<const char*, kEndings> kEndingNames{"goes_on", "reached",     "stationary", "settled",
                                                                "stalled", "postponed",   "no_energy",  "crowded",
                                                                "capped",  "out_of_work", "unplaced",   "invalid"};
/// Name of an ending in metrics, server states and `hl trace`.
constexpr const char* nameOf(Ending ending) { return kEndingNames[static_cast<std::size_t>(ending)]; }

struct TickReport {
  FixedVector<ProxyContact, kMaxActive> contacts;
  Vec3 target =
      Vec3::Zero();  ///< where the servo pulls the finger: the rest of its spring, softened by the surface stiffness
  /// Of a proxy that a snap (snapping.h) or matter (matter_drag.h) holds: its part of anchor of the spring - finger,
  /// which no contact holds. Times K s it is its force. World.
  Vec3 held_pull_m = Vec3::Zero();
  Vec3 snap_point = Vec3::Zero();  ///< of the snap, world
  double injected_J = 0;           ///< change of the spring's energy by the tick: positive: added, negative: dissipated
  double moved_J = 0;              ///< change of the spring's energy by moving objects before the tick
  int iterations = 0;
  std::size_t work = 0;  ///< cost of the tick, in bounding volumes (work.h)
  int looks = 0;         ///< number of times that contacts were gathered
  int used_up_at = 0;    ///< number of looks after which the work limit was reached; 0: not reached
  bool yields = false;   ///< one of the contacts yields (yielding.h)
  bool stayed = false;   ///< no work was left while a surface held the proxy: it is where and as it was
  Ending ending = Ending::kGoesOn;
  /// `earlier` looks of attempts whose result does not count were made before, in the same tick.
  void addEarlierLooks(int earlier) {
    looks += earlier;
    if (used_up_at > 0) used_up_at += earlier;
  }
  /// Stopped by the iteration cap before the local minimum, at a valid position.
  bool capped() const { return ending == Ending::kCapped; }
  bool placed() const { return ending != Ending::kUnplaced; }
  bool valid() const { return ending != Ending::kInvalid; }
};

}  // namespace hl
