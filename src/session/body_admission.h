// BodyAdmission: whether the world has room for more bodies and joints.
#pragma once

#include <cstddef>

#include "scene/scene_limits.h"
#include "session/check_bodies.h"

namespace hl {

/// One thread at a time.
class BodyAdmission {
 public:
  /// `devices`: how many touch the world.
  BodyAdmission(const WorldParts& base, std::size_t devices) : base_(base), devices_(devices) {}

  /// Throws hl::Error where those of a client, those of `others` and the base's are more than its limits say.
  void check(const WorldParts& parts, const WorldParts& others, const SceneLimits& limits) const;
  /// The same of another base beside those of all clients; the limits are those of a world.
  void checkBase(const WorldParts& base, const WorldParts& clients) const;
  void setBase(const WorldParts& base) { base_ = base; }
  /// Another base will take the place of this one: from now on as much counts as the larger of both has.
  void reserve(const WorldParts& base);

 private:
  WorldParts base_;
  const std::size_t devices_;
};

}  // namespace hl
