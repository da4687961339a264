#include "proxy/walk.h"

#include <algorithm>

namespace hl {

bool Walk::go(const ContactSet& set, bool along, const Vec3& step, Vec3& position) {
  const double length = step.norm();
  const double longest_m = std::min(leg_m_, input_.longest_m);
  const bool whole = length <= longest_m;
  const Vec3 motion = whole ? step : Vec3(step * (longest_m / length));
  SceneImpact impact;
  const bool hit = firstImpact(set, along, position, motion, impact);
  const double slid_before_m = set.contacts.empty() ? slid_m_ : 0;
  slid_m_ = along ? slid_before_m + std::min(length, longest_m) : 0;
  position += hit ? Vec3(impact.impact.t * motion) : motion;
  cache_.nearby.endAt(position);
  if (!whole && !hit) leg_m_ *= 2;
  return whole && !hit;
}

// All primitives lie within a ball about the scene. If the proxy is outside it, it moves to where its way enters the
// ball, or directly to the finger if the way does not meet the ball.
void Walk::fly(const ContactSet& set, Vec3& position) {
  const Vec3 from = position, way = input_.finger - from;
  const FarGoal::Within ball = input_.far.within(from, way);
  const bool misses = ball.leave < ball.enter;
  if (!misses && ball.enter > 0) {
    position = from + ball.enter * way;
    return cache_.nearby.endAt(position);
  }
  // Without contact the proxy equals the finger bit by bit.
  if (misses || go(set, false, ball.leave * way, position)) cache_.nearby.endAt(position = input_.finger);
}

// Typical length of a step. It affects only the cost. Along a surface: a fraction of the reach. A proxy that has left a
// convex surface meets it again after some hundredths of the way that it slid.
double Walk::likelyWay_m(bool along) const {
  using namespace cost;
  if (along) return kSlidePerReach * input_.tolerance.reach;
  return slid_m_ > 0 ? kFallPerSlide * slid_m_ : kFallPerReach * input_.tolerance.reach;
}

// Finds the first impact from the cache alone. Returns false if the cache does not suffice: it covers only a part of
// the way and has no impact on that part. Along a surface a partly covered way is not tested, as it usually continues
// beyond the covered part.
bool Walk::cacheAnswers(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion,
                        std::span<const PrimitiveId> contacts, bool& hit, SceneImpact& out) {
  SweepCache& nearby = cache_.nearby;
  const SceneAt& scene = input_.scene;
  const Tolerances& tolerance = input_.tolerance;
  if ((!along && !nearby.isBall()) || !nearby.covers(scene, from, tolerance.touching)) return false;
  const bool whole = nearby.covers(scene, from + motion, tolerance.touching) ||
                     (along && cache_.ahead.find(scene, set, tolerance, from, motion, nearby));
  const double slack = whole || along ? 0 : nearby.slack_m(from, tolerance.touching);
  if (!whole && slack <= 0) return false;
  const double length = motion.norm();
  const Vec3 to = from + (whole ? 1 : slack / length) * motion;
  FixedVector<PrimitiveId, SweepCache::kRoom> met;
  nearby.forEach(from, to, tolerance.touching + tolerance.skin, [&](PrimitiveId primitive) {
    if (std::find(contacts.begin(), contacts.end(), primitive) == contacts.end()) met.push(primitive);
  });
  hit = scene.firstImpactAmong({met.begin(), met.size()}, from, motion, tolerance.swept, out);
  return whole || (hit && out.impact.t * length <= slack);
}

bool Walk::firstImpact(const ContactSet& set, bool along, const Vec3& from, const Vec3& motion, SceneImpact& out) {
  SweepCache& nearby = cache_.nearby;
  const Tolerances& tolerance = input_.tolerance;
  FixedVector<PrimitiveId, SweepCache::kRoom> known;
  if (!primitivesOf(set, known)) {
    nearby.forget();
    return input_.scene.firstImpact(
        from, motion, tolerance.swept,
        [&](const ClosestPoint& start) {
          return start.distance <= tolerance.touching &&
                 (!set.crowd || holdsBy(set, {start.normal, tolerance.reach - start.distance}));
        },
        out);
  }
  const std::span<const PrimitiveId> contacts(known.begin(), known.size());
  bool hit = false;
  if (cacheAnswers(set, along, from, motion, contacts, hit, out)) return hit;
  nearby.begin(input_.scene, tolerance.touching);
  return input_.scene.firstImpact(
      from, motion, tolerance.swept, tolerance.touching, likelyWay_m(along), contacts,
      [&](PrimitiveId primitive) { nearby.add(primitive); }, out);
}

}  // namespace hl
