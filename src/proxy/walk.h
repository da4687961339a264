// Walk: moves the proxy by a step, or to its first impact with a primitive that is no contact yet. Contacts are kept
// away by their planes, all other primitives are swept: never both, never neither.
//
// The cost of a sweep grows faster than the square of its length, and a tick cannot end within a sweep. So a long way
// is split into legs, each a step of the tick.
//
// Invariant: the proxy's centre stays `swept` away from every primitive that is no contact.
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
  bool cacheAnswers(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion,
                    std::span<const PrimitiveId> contacts, bool& hit, SceneImpact& out);
  bool firstImpact(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion, SceneImpact& out);

  const TickInput& input_;
  ProxyCache& cache_;
  double slid_m_ = 0;
  double leg_m_;  // of the longest sweep that comes next: twice that after each leg
};

}  // namespace hl
