// LookaheadBall: one search for several ticks. If triangles are large compared to the steps of the proxy, a ball ahead
// of it contains all primitives that the next ticks can touch, and these are few. Until the proxy leaves the ball, the
// hierarchy is not searched. If triangles are small the ball would contain too many, and each step searches the
// hierarchy. Where a search makes the primitives anew, as in a volume, it costs more, and the ball may contain more.
#pragma once

#include "proxy/back_off.h"
#include "proxy/contacts.h"
#include "proxy/sweep_cache.h"
#include "proxy/tolerances.h"

namespace hl {

/// Plain values; RT-safe. It affects only the computing time.
class LookaheadBall {
 public:
  /// To be called at the start of each tick.
  void follow(const Vec3& finger) {
    travel_m_ = (finger - finger_).norm();
    finger_ = finger;
  }
  /// Fills `nearby` with the primitives of a ball that starts at `from` and extends along `motion` for some ticks.
  /// `set`: the current contacts. Returns false if a ball is not worthwhile or does not cover the whole motion;
  /// `nearby` is then usually unchanged.
  bool find(const SceneAt& scene, const ContactSet& set, const Tolerances& tolerance, const Vec3& from,
            const Vec3& motion, SweepCache& nearby);

 private:
  /// What a ball may be for the search to be worthwhile.
  struct Limits {
    double disc_m2 = 0;  ///< area that it cuts out of the plane of a contact
    double min_ticks = 0;
    std::size_t max_primitives = 0;
  };
  static Limits limitsOf(const SceneAt& scene, const ContactSet& set);
  double slack_m(const Limits& limits, double touching) const;

  Vec3 finger_ = Vec3::Zero();
  double travel_m_ = 0;  // motion of the finger in this tick
  BackOff back_off_;     // after balls with too many primitives
};

}  // namespace hl
