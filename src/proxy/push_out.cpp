#include "proxy/push_out.h"

#include "proxy/clear_place.h"

namespace hl {

Vec3 pushedOut(const SceneAt& scene, const Tolerances& tolerance, const Vec3& from) {
  Vec3 roomiest = from;
  double most_room = 0;
  Tolerances smaller = tolerance;
  for (int i = 0; i <= accuracy::kPinchHalvings && most_room < smaller.reach; ++i, smaller.reach /= 2) {
    const int tries = i == 0 ? convergence::kPushTries : convergence::kPinchedTries;
    Vec3 place = from;
    const bool clear = findClearPlace(scene, smaller, tries, place);
    const double room = clear && i == 0 ? tolerance.reach : clearanceAt(scene, place, tolerance.reach);
    if (room <= most_room) continue;
    most_room = room;
    roomiest = place;
  }
  return roomiest;
}

}  // namespace hl
