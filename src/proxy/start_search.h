// Start search: finds a start position for a proxy whose finger is inside an object. Candidates are tried one after
// another, each pushed a little out of what it overlaps, until one is clear of the scene:
//   the finger itself;
//   the far side of each of the nearest primitives that it overlaps: for a thin wall, the outside;
//   points around the finger, on spheres that grow to convergence::kFarthestStart reaches.
// The state of the search is the number of the next candidate. So the search can be spread over several ticks, and it
// follows the finger.
#pragma once

#include "base/vec.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// Plain values; RT-safe.
class StartSearch {
 public:
  StartSearch() = default;
  /// Goes on where another one was, as next() gave; 0 <= `next` < kPlaces.
  explicit StartSearch(int next) : next_(next) {}
  int next() const { return next_; }

  /// Tests the finger and the next `places` candidates. Returns whether one is clear; then `position` is set to it and
  /// the search restarts.
  bool look(const SceneAt& scene, const Tolerances& tolerance, const Vec3& finger, int places, Vec3& position);

  /// Number of candidates; after the last the search restarts with the first.
  static const int kPlaces;

 private:
  int next_ = 0;
};

}  // namespace hl
