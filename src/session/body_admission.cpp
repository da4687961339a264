#include "session/body_admission.h"

#include <algorithm>

namespace hl {

// Who brings no bodies is not refused for those of others.
void BodyAdmission::check(const WorldParts& parts, const WorldParts& others, const SceneLimits& limits) const {
  if (parts.bodies == 0) return;
  WorldParts all = base_;
  all += others;
  all += parts;
  checkBodiesOfAll(all, {limits.bodies, limits.joints}, devices_);
}

void BodyAdmission::reserve(const WorldParts& base) {
  base_.bodies = std::max(base_.bodies, base.bodies);
  base_.joints = std::max(base_.joints, base.joints);
}

void BodyAdmission::checkBase(const WorldParts& base, const WorldParts& clients) const {
  WorldParts all = base;
  all += clients;
  if (all.bodies > 0) checkBodiesOfAll(all, {kMaxBodies, kMaxJoints}, devices_);
}

}  // namespace hl
