#include "proxy/lookahead_ball.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Area of a triangle; 0 for other primitives.
double area_m2(const Primitive& p) { return 0.5 * (p.vertex[1] - p.vertex[0]).cross(p.vertex[2] - p.vertex[0]).norm(); }

}  // namespace

// How much larger than the proxy a ball may be, m, so that its disc is as large as the triangles allow: (R + s)^2 - R^2
// = disc / pi.
double LookaheadBall::slack_m(const SceneAt& scene, const ContactSet& set, double touching) const {
  if (set.contacts.empty() || set.contacts.size() > cost::kMaxBallContacts) return 0;
  double area = area_m2(scene.primitive(set.contacts[0].primitive));
  for (std::size_t i = 1; i < set.contacts.size(); ++i)
    area = std::min(area, area_m2(scene.primitive(set.contacts[i].primitive)));
  const double most = std::sqrt(touching * touching + area / (M_PI * cost::kTrianglePerDisc)) - touching;
  return std::min(most, 0.5 * cost::kMaxBallTicks * travel_m_);
}

bool LookaheadBall::find(const SceneAt& scene, const ContactSet& set, const Tolerances& tolerance, const Vec3& from,
                         const Vec3& motion, SweepCache& nearby) {
  const double length = motion.norm();
  const bool moves = scene.time_ns() < scene.snapshot().moves_until_ns;
  if (!(length > 0 && length <= cost::kMaxBallTicks * travel_m_) || moves || !back_off_.mayTry()) return false;
  const double slack = slack_m(scene, set, tolerance.touching);
  if (2 * slack < std::max(length, cost::kMinBallTicks * travel_m_)) return false;
  const Vec3 centre = from + slack / length * motion;
  const double covered = tolerance.touching + slack + tolerance.skin;
  nearby.beginAround(scene, centre, covered);
  const auto add = [&](PrimitiveId primitive, const ClosestPoint& nearest) { nearby.add(primitive, nearest); };
  if (!scene.fewWithin(centre, covered + tolerance.skin, SweepCache::kRoom, add)) nearby.forget();
  if (nearby.size() <= cost::kMaxInBall) {
    back_off_.worked();
  } else {
    back_off_.failed();
  }
  return nearby.covers(scene, from + motion, tolerance.touching);
}

}  // namespace hl
