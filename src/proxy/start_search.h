// Start search: where a proxy begins whose finger is inside something. Places are tried one after another until one is
// clear of the scene, each pushed a little out of what it overlaps:
//   the finger itself;
//   beyond each of the nearest things that it overlaps: of a thin wall, the outside;
//   all around the finger, on spheres that grow to convergence::kFarthestStart radii.
// Which is next is one number, so a search costs little in each tick, goes on in the next, and follows the finger.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// Plain values; RT-safe.
class StartSearch {
 public:
  /// Looks at the finger and the next `places` places about it. Returns whether one is clear; it is in `position` then,
  /// and the search begins anew.
  bool look(const SceneAt& scene, const Tolerances& tolerance, const Vec3& finger, int places, Vec3& position);

  /// So many places are all there are; then it begins with the first again.
  static const int kPlaces;

 private:
  int next_ = 0;
};

}  // namespace hl
