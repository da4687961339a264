// Walk: moves the proxy by a step, or to its first impact with a primitive that is no contact yet. Contacts are held
// off by their planes, all other primitives are swept; none is both and none is neither.
//
// What a sweep costs grows with the square of its length and more, and no tick can end within one. So a long way is
// gone in legs, each a step of the tick.
//
// Invariant: the proxy's centre stays `swept` away from all that is no contact, so the way is free.
#pragma once

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
  Walk(const TickInput& input, ProxyCache& cache)
      : input_(input), cache_(cache), leg_m_(convergence::kFirstLegPerReach * input.tolerance.reach) {
    cache.ahead.follow(input.finger);
  }

  /// Moves `position` by `step`, or by its first leg; `along`: along a surface. Returns whether it has gone the whole
  /// way.
  bool go(const ContactSet& set, bool along, const Vec3& step, Vec3& position);
  /// In the open: to the finger, or to what is met first.
  void fly(const ContactSet& set, Vec3& position);

  /// How far the steps since the last touch wanted to go along a surface, m; 0: the last did not.
  double slid_m() const { return slid_m_; }

 private:
  double likelyWay_m(bool along) const;
  bool cacheTells(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion,
                  std::span<const PrimitiveId> contacts, bool& hit, SceneImpact& out);
  bool firstImpact(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion, SceneImpact& out);

  const TickInput& input_;
  ProxyCache& cache_;
  double slid_m_ = 0;
  double leg_m_;  // of the longest sweep that comes next: twice that after each leg
};

}  // namespace hl
