#include "proxy/walk.h"

#include <algorithm>

namespace hl {

Walk::Made Walk::go(const ContactSet& set, Along along, const Vec3& step, Vec3& position) {
  const double length = step.norm();
  const double longest_m = std::min(leg_m_, input_.longest_m);
  const bool whole = length <= longest_m;
  const Vec3 motion = whole ? step : Vec3(step * (longest_m / length));
  const std::optional<SceneImpact> hit = firstImpact(set, along, position, motion);
  const double slid_before_m = set.contacts.empty() ? slid_m_ : 0;
  slid_m_ = along == Along::kSurface ? slid_before_m + std::min(length, longest_m) : 0;
  position += hit ? Vec3(hit->impact.t * motion) : motion;
  cache_.nearby.endAt(position);
  if (!whole && !hit) leg_m_ *= 2;
  return whole && !hit ? Made::kWhole : Made::kPart;
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
  if (misses || go(set, Along::kAir, ball.leave * way, position) == Made::kWhole)
    cache_.nearby.endAt(position = input_.finger);
}

// Typical length of a step. It affects only the cost. Along a surface: a fraction of the reach. A proxy that has left a
// convex surface meets it again after some hundredths of the way that it slid.
double Walk::likelyWay_m(Along along) const {
  using namespace cost;
  if (along == Along::kSurface) return kSlidePerReach * input_.tolerance.reach;
  return slid_m_ > 0 ? kFallPerSlide * slid_m_ : kFallPerReach * input_.tolerance.reach;
}

// Finds the first impact from the cache alone. The cache does not suffice if it covers only a part of the way and has
// no impact on that part. Along a surface a partly covered way is not tested, as it usually continues beyond the
// covered part.
Walk::FromCache Walk::askCache(const ContactSet& set, Along along, const Vec3& from, const Vec3& motion,
                               std::span<const PrimitiveId> contacts) {
  const bool slides = along == Along::kSurface;
  SweepCache& nearby = cache_.nearby;
  const SceneAt& scene = input_.scene;
  const Tolerances& tolerance = input_.tolerance;
  if ((!slides && !nearby.isBall()) || !nearby.covers(scene, from, tolerance.touching)) return {};
  const bool whole = nearby.covers(scene, from + motion, tolerance.touching) ||
                     (slides && cache_.ahead.find(scene, set, tolerance, from, motion, nearby));
  const double slack = whole || slides ? 0 : nearby.slack_m(from, tolerance.touching);
  if (!whole && slack <= 0) return {};
  const double length = motion.norm();
  const Vec3 to = from + (whole ? 1 : slack / length) * motion;
  FixedVector<PrimitiveId, SweepCache::kRoom> met;
  nearby.forEach(from, to, tolerance.touching + tolerance.skin, [&](PrimitiveId primitive) {
    if (std::find(contacts.begin(), contacts.end(), primitive) == contacts.end()) met.push(primitive);
  });
  SceneImpact impact;
  if (!scene.firstImpactAmong({met.begin(), met.size()}, from, motion, tolerance.swept, impact)) return {whole};
  return {whole || impact.impact.t * length <= slack, impact};
}

std::optional<SceneImpact> Walk::firstImpact(const ContactSet& set, Along along, const Vec3& from, const Vec3& motion) {
  SweepCache& nearby = cache_.nearby;
  const Tolerances& tolerance = input_.tolerance;
  SceneImpact impact;
  FixedVector<PrimitiveId, cost::kKnownRoom> known;
  if (!primitivesOf(set, known)) {
    nearby.forget();
    const bool hit = input_.scene.firstImpact(
        from, motion, tolerance.swept,
        [&](const ClosestPoint& start) {
          return start.distance <= tolerance.touching &&
                 (!set.crowd || holdsBy(set, {start.normal, tolerance.reach - start.distance}));
        },
        impact);
    return hit ? std::optional(impact) : std::nullopt;
  }
  const std::span<const PrimitiveId> contacts(known.begin(), known.size());
  const FromCache cached = askCache(set, along, from, motion, contacts);
  if (cached.suffices) return cached.impact;
  nearby.begin(input_.scene, tolerance.touching);
  const bool hit = input_.scene.firstImpact(
      from, motion, tolerance.swept, tolerance.touching, likelyWay_m(along), contacts,
      [&](PrimitiveId primitive) { nearby.add(primitive); }, impact);
  return hit ? std::optional(impact) : std::nullopt;
}

}  // namespace hl
