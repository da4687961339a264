#include "proxy/lookahead_ball.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Area of a triangle; 0 for other primitives.
double area_m2(const Primitive& p) { return 0.5 * (p.vertex[1] - p.vertex[0]).cross(p.vertex[2] - p.vertex[0]).norm(); }

}  // namespace

LookaheadBall::Limits LookaheadBall::limitsOf(const SceneAt& scene, const ContactSet& set) {
  using namespace cost;
  if (set.contacts.empty() || set.contacts.size() > kMaxBallContacts) return {};
  const double cell_m = scene.shape(set.contacts[0].primitive).index->cellSize_m();
  if (cell_m > 0) return {kDiscPerCell * cell_m * cell_m, kMinBallTicksInCells, kMaxInBallOfCells};
  double area = area_m2(scene.primitive(set.contacts[0].primitive));
  for (std::size_t i = 1; i < set.contacts.size(); ++i)
    area = std::min(area, area_m2(scene.primitive(set.contacts[i].primitive)));
  return {area / kTrianglePerDisc, kMinBallTicks, kMaxInBall};
}

// How much larger than the proxy a ball may be, m: (R + s)^2 - R^2 = disc / pi.
double LookaheadBall::slack_m(const Limits& limits, double touching) const {
  const double most = std::sqrt(touching * touching + limits.disc_m2 / M_PI) - touching;
  return std::min(most, 0.5 * cost::kMaxBallTicks * travel_m_);
}

bool LookaheadBall::find(const SceneAt& scene, const ContactSet& set, const Tolerances& tolerance, const Vec3& from,
                         const Vec3& motion, SweepCache& nearby) {
  const double length = motion.norm();
  const bool moves = scene.time_ns() < scene.snapshot().moves_until_ns;
  if (!(length > 0 && length <= cost::kMaxBallTicks * travel_m_) || moves || !back_off_.mayTry()) return false;
  const Limits limits = limitsOf(scene, set);
  const double slack = slack_m(limits, tolerance.touching);
  if (2 * slack < std::max(length, limits.min_ticks * travel_m_)) return false;
  const Vec3 centre = from + slack / length * motion;
  const double covered = tolerance.touching + slack + tolerance.skin;
  nearby.beginAround(scene, centre, covered);
  const auto add = [&](PrimitiveId primitive, const ClosestPoint& nearest) { nearby.add(primitive, nearest); };
  if (!scene.fewWithin(centre, covered + tolerance.skin, SweepCache::kRoom, add)) nearby.forget();
  if (nearby.size() <= limits.max_primitives) {
    back_off_.worked();
  } else {
    back_off_.failed();
  }
  return nearby.covers(scene, from + motion, tolerance.touching);
}

}  // namespace hl
