#include "proxy/clear_place.h"

#include <algorithm>
#include <span>

#include "proxy/contacts.h"
#include "proxy/solver.h"

namespace hl {

// Each step is swept with a fraction of the largest sphere that is clear of the scene at its start. Its length is
// limited to one radius, because planes that almost face each other may have their first common point at any distance.
bool findClearPlace(const SceneAt& scene, const Tolerances& tolerance, int tries, Vec3& position) {
  ContactSet set;
  for (int i = 0; i < tries; ++i) {
    gatherContacts(scene, position, tolerance.reach - tolerance.skin, tolerance.reach, set);
    if (set.contacts.empty()) return true;
    double clearance = tolerance.reach;
    for (const Contact& contact : set.contacts) clearance = std::min(clearance, contact.distance);
    const std::span<const Plane> planes(set.planes.begin(), set.planes.size());
    Vec3 step = nearestAbove(planes, Vec3::Zero(), tolerance.feasible).point;
    const double length = step.norm();
    if (length > tolerance.reach) step *= tolerance.reach / length;
    SceneImpact impact;
    const double safe = convergence::kPushedPart * clearance;
    if (safe > 0 && scene.firstImpact(position, step, safe, -1, impact)) {
      position += impact.impact.t * step;
    } else {
      position += step;
    }
  }
  return false;
}

double clearanceAt(const SceneAt& scene, const Vec3& position, double most) {
  double least = most;
  scene.primitivesWithin(position, most,
                         [&](PrimitiveId, const ClosestPoint& nearest) { least = std::min(least, nearest.distance); });
  return least;
}

}  // namespace hl
