// LookaheadBall: one search for several ticks. Where triangles are larger than the steps of the proxy, a ball ahead of
// it contains the few primitives that the next ticks can touch: until the proxy leaves the ball, no other search is
// needed. Where triangles are small the ball would contain too many, and each step searches the hierarchy.
#pragma once

#include "proxy/back_off.h"
#include "proxy/contacts.h"
#include "proxy/sweep_cache.h"
#include "proxy/tolerances.h"

namespace hl {

/// Plain values; RT-safe. It decides nothing but how long a tick takes.
class LookaheadBall {
 public:
  /// A tick begins, with the finger there.
  void follow(const Vec3& finger) {
    travel_m_ = (finger - finger_).norm();
    finger_ = finger;
  }
  /// Fills `nearby` with the primitives in a ball that contains `from` and, for some ticks, the way along `motion`.
  /// Returns false, mostly with `nearby` unchanged, where it is not worth it. `set`: the contacts now.
  bool find(const SceneAt& scene, const ContactSet& set, const Tolerances& tolerance, const Vec3& from,
            const Vec3& motion, SweepCache& nearby);

 private:
  double slack_m(const SceneAt& scene, const ContactSet& set, double touching) const;

  Vec3 finger_ = Vec3::Zero();
  double travel_m_ = 0;  // of the finger, in this tick
  BackOff back_off_;     // from balls with too much in them
};

}  // namespace hl
