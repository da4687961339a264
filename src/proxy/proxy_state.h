// The proxy's settings, and the state that a tick leaves for the next one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/fixed_vector.h"
#include "base/ledger.h"
#include "base/vec.h"
#include "proxy/compliance_estimate.h"
#include "proxy/presliding.h"
#include "proxy/proxy_cache.h"
#include "proxy/solver.h"
#include "proxy/start_search.h"
#include "proxy/tolerances.h"
#include "scene/material.h"
#include "scene/scene_at.h"

namespace hl {

/// How often the two passes of force shading run.
enum class ShadingPasses : std::uint8_t {
  kConverged,  ///< to the fixed point: finger - proxy along the shaded normal where the proxy is
  kOnce,       ///< once a tick, as the paper does; the fixed point is approached over the next ticks
};

/// A work_cap, or a number of looks, that no tick reaches.
inline constexpr int kNoWorkCap = std::numeric_limits<int>::max();

struct ProxySettings {
  double radius = 0.001;     ///< m, > 0
  int iteration_cap = 1000;  ///< a tick that needs more steps stops at its current, valid position
  int work_cap = 9'000;  ///< the same for a tick that needs more work (work.h), about 50 us. After many such ticks in a
                         ///< row up to 16 times as much
  double spring_N_m = 1000;     ///< K of the servo, at the hand: scales viscosity and the ledger
  double period_s = 1e-3;       ///< T, one tick: scales viscosity
  double world_per_device = 1;  ///< metres of the scene for one of the hand: scales the ledger
  ShadingPasses shading = ShadingPasses::kConverged;
  LedgerMode ledger = LedgerMode::kTank;
  MaterialOverride surfaces{};  ///< user settings that override the scene

  double springInWorld_N_m() const { return spring_N_m / world_per_device; }  ///< N at the hand for 1 m of the scene
};

/// A contact with a surface that holds the proxy until the pull along `normal` exceeds `adhesion_N`.
struct AdheringContact {
  Vec3 normal;  ///< unit, from the surface to the proxy
  double adhesion_N;
};
using AdheringContacts = FixedVector<AdheringContact, kMaxActive>;

/// What friction remembers from tick to tick (friction.h).
struct Sticking {
  double since_slip_s = accuracy::kStuck_s;  ///< time since the last slip; from kStuck_s on the proxy is stuck
  PreslidingSprings springs{};               ///< on which friction holds the proxy (presliding.h)

  bool isStuck() const { return since_slip_s >= accuracy::kStuck_s; }
  void goOn(bool slipped, double period_s) {
    since_slip_s = slipped ? 0 : std::min(since_slip_s + period_s, accuracy::kStuck_s);
  }
};

/// A contact of the last tick, as one of the springs that yield (yielding.h).
struct YieldingContact {
  std::uint64_t key = 0;        ///< of the instance
  double stiffness = 1;         ///< s0
  double material_m_N = 0;      ///< C of the material
  double multiplier_m = 0;      ///< its weight in the mean stiffness
  double share = 1;             ///< its part of the normal force of its object, 0..1
  double along = 1;             ///< square of the cosine between the pull of its object and `normal`
  Vec3 part_m = Vec3::Zero();   ///< its part e_i of proxy - finger
  Vec3 normal = Vec3::UnitY();  ///< unit: of the normal force of its object
};
using YieldingContacts = FixedVector<YieldingContact, kMaxActive>;

/// Where the spring is fixed as contacts yield (yielding.h).
struct Yielding {
  YieldingContacts contacts{};    ///< of the last tick; empty if none of them yields
  double stiffness = 1;           ///< s of these contacts
  Vec3 offset_m = Vec3::Zero();   ///< where the spring is fixed - proxy; 0 if nothing yields
  Vec3 sharing_m = Vec3::Zero();  ///< the part of it by which contacts share the pull as they yield
  Vec3 pressed_m = Vec3::Zero();  ///< s times the rest of it, C F_k: times K what meshes press by F_k

  void dropOffset() { offset_m = sharing_m = pressed_m = Vec3::Zero(); }
};

/// A surface that held the proxy in the last tick (changed_stiffness.h).
struct HeldSurface {
  std::uint64_t key = 0;                   ///< of the instance
  ElementId element = 0;                   ///< of its shape
  std::array<double, 3> weights{1, 0, 0};  ///< of the contact point
  double multiplier_m = 0;                 ///< its weight in the mean stiffness
  double stiffness = 1;                    ///< s
};

/// The stiffness in the last tick (changed_stiffness.h).
struct HeldStiffness {
  FixedVector<HeldSurface, kMaxActive> surfaces{};  ///< of its contacts
  std::optional<double> said{};                     ///< what the user had set for all surfaces
};

/// Keys of objects that have let the proxy through and still overlap it (piercing.h).
using PiercedObjects = FixedVector<std::uint64_t, SceneAt::kMaxLeftOut>;

/// Keys of objects in whose matter the proxy is (leave_matter.h).
using MatterObjects = FixedVector<std::uint64_t, kMaxMatter>;

/// The snap that holds the proxy (snapping.h).
struct HeldSnap {
  std::uint64_t key = 0;     ///< of its instance; 0: none holds it
  std::uint32_t number = 0;  ///< in Instance::snaps
  bool holds() const { return key != 0; }
};

/// World frame. Owned by the proxy loop.
struct ProxyState {
  Vec3 position = Vec3::Zero();  ///< centre of the sphere
  bool free = false;             ///< false until a position clear of the scene has been found near the finger
  bool touching = false;         ///< the last tick ended in contact, between two contacts, or held by a snap
  Sticking sticking{};
  double stiffness = 1;        ///< stiffness s of the last tick's target; 1 without contact
  std::int64_t time_ns = 0;    ///< scene time of the last tick
  std::uint64_t snapshot = 0;  ///< number of the snapshot of the last tick; 0: none yet
  std::uint64_t carrier = 0;   ///< key of the object whose friction or snap holds the proxy; 0: none
  HeldSnap snap{};
  PiercedObjects pierced{};
  MatterObjects within{};
  AdheringContacts adhering{};  ///< adhesive contacts of the last tick (adhesion.h)
  HeldStiffness held{};
  Yielding yielding{};
  ComplianceEstimate estimate{};
  Ledger ledger{};
  int out_of_work = 0;  ///< consecutive ticks that ran out of work; more of them raise the limit (mostWork in tick.cpp)
  StartSearch start{};  ///< used while the proxy is not free
  ProxyCache cache{};

  /// Where the spring is fixed: at the proxy, but for what yields.
  Vec3 anchor() const { return position + yielding.offset_m; }
};

}  // namespace hl
