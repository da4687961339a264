// Walk: moves the proxy by a step, or up to its first impact with a primitive that is not yet a contact. Contacts are
// kept away by their planes, and all other primitives are swept: every primitive is treated in exactly one of these
// ways.
//
// The cost of a sweep grows at least with the square of its length, and a tick cannot end within a sweep. So a long way
// is split into legs, and each leg is one step of the tick.
//
// Invariant: the proxy's centre stays at least Tolerances::swept away from all primitives that are not contacts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/proxy_cache.h"
#include "proxy/tick_input.h"
#include "proxy/tolerances.h"

namespace hl {

/// For one tick. World frame. RT-safe.
class Walk {
 public:
  /// What a step follows. Along a surface what it meets is known from the steps before, more often than not.
  enum class Along : std::uint8_t { kAir, kSurface };
  /// How much of a step was made.
  enum class Made : std::uint8_t { kWhole, kPart };

  Walk(const TickInput& input, ProxyCache& cache)
      : input_(input), cache_(cache), leg_m_(convergence::kFirstLegPerReach * input.tolerance.reach) {
    cache.ahead.follow(input.finger);
  }

  /// Moves `position` by `step`, by the first leg of it, or up to the first impact.
  Made go(const ContactSet& set, Along along, const Vec3& step, Vec3& position);
  /// Without contacts: moves to the finger, or up to the first impact.
  void fly(const ContactSet& set, Vec3& position);

  /// Length of the steps along a surface, as requested, since the last contact, m; 0: the last step did not follow a
  /// surface.
  double slid_m() const { return slid_m_; }

 private:
  struct FromCache {
    bool suffices = false;  // false: what is not in the cache may be met
    std::optional<SceneImpact> impact{};
  };

  double likelyWay_m(Along along) const;
  FromCache askCache(const ContactSet& set, Along along, const Vec3& from, const Vec3& motion,
                     std::span<const PrimitiveId> contacts);
  std::optional<SceneImpact> firstImpact(const ContactSet& set, Along along, const Vec3& from, const Vec3& motion);

  const TickInput& input_;
  ProxyCache& cache_;
  double slid_m_ = 0;
  double leg_m_;  // longest sweep of the next step; doubled after each leg
};

}  // namespace hl
