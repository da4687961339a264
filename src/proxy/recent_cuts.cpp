#include "proxy/recent_cuts.h"

#include <algorithm>

namespace hl {

namespace {

bool touches(const ContactSet& set, PrimitiveId primitive) {
  const auto same = [&](const Contact& contact) { return contact.primitive == primitive; };
  return std::any_of(set.contacts.begin(), set.contacts.end(), same) ||
         std::any_of(set.twins.begin(), set.twins.end(), same);
}

}  // namespace

void RecentCuts::update(const ContactSet& set) {
  left_.clear();
  for (const PrimitiveId primitive : active_) {
    if (!touches(set, primitive)) left_.push(primitive);
  }
  active_.clear();
}

std::size_t RecentCuts::addPlanes(const SceneAt& scene, const Vec3& position, double reach, Planes& planes) const {
  const std::size_t before = planes.size();
  for (const PrimitiveId primitive : left_) {
    const ClosestPoint nearest = scene.closest(primitive, position);
    if (nearest.distance <= convergence::kCutNear * reach) planes.push({nearest.normal, reach - nearest.distance});
  }
  return planes.size() - before;
}

void RecentCuts::keepActive() {
  for (const PrimitiveId primitive : left_) active_.push(primitive);
}

}  // namespace hl
