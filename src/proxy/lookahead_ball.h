// LookaheadBall: one search for several ticks. Where triangles are large beside the steps of the proxy, a ball ahead of
// it holds all that the next ticks can touch, and that is little: until the proxy leaves the ball, nothing else is
// asked. Where triangles are small the ball would hold too many, and each step asks the hierarchy.
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
  /// Fills `nearby` with what a ball holds that begins at `from`, goes on along `motion` for some ticks, and covers all
  /// of it. False, mostly with `nearby` as it was, where that is not worth it. `set` is what touches the proxy now.
  bool find(const SceneAt& scene, const ContactSet& set, const Tolerances& tolerance, const Vec3& from,
            const Vec3& motion, SweepCache& nearby);

 private:
  double slack_m(const SceneAt& scene, const ContactSet& set, double touching) const;

  Vec3 finger_ = Vec3::Zero();
  double travel_m_ = 0;  // of the finger, in this tick
  BackOff back_off_;     // from balls with too much in them
};

}  // namespace hl
