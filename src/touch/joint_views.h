// Joint views: reports to other threads what the joints of a world do, after each step.
#pragma once

#include <memory>
#include <vector>

#include "bodies/world.h"

namespace hl {

/// By the loop that steps the bodies.
class JointViews {
 public:
  /// Of those joints of the scene for which somebody asks. Allocates.
  JointViews(const Snapshot& scene, const World& world);
  /// After a step of this length; what sleeps is not reported again. RT-safe.
  void show(const World& world, const WorldState& state, double period_s);

 private:
  struct One {
    std::size_t joint = 0, body = 0;  // numbers in the world; body a
    bool turned_round = false;        // the world's joint has the spec's two bodies the other way round
    bool asleep = false;
    std::shared_ptr<SharedJoint> shown;
  };
  std::vector<One> views_;
};

}  // namespace hl
