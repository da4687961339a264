// NextScene: makes one scene of the base and of what all clients have, as it follows on from the one that is shown.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "session/base_scene.h"
#include "session/scene_parts.h"

namespace hl {

/// The publisher's thread.
class NextScene {
 public:
  /// The base outlives it, and is what is shown.
  explicit NextScene(const BaseScene& base) : base_(base), shown_(base.now()) {}

  std::uint64_t number() const { return shown_->number + 1; }
  /// Made before its motions begin. States in `parts` what of it each client has.
  std::shared_ptr<const Snapshot> make(SceneParts& parts);
  /// When the motions of the one that was made last begin.
  std::int64_t begin_ns() const { return begin_ns_; }
  /// It is shown: the next one follows on from it.
  void markShown(const std::shared_ptr<const Snapshot>& scene, SceneParts& parts) noexcept;

 private:
  std::int64_t assemble(std::vector<ScenePart>& parts, std::vector<Instance>& instances) const;
  std::int64_t follow(ScenePart& part, std::vector<Instance>& instances) const;
  void keepShown(const ClientScene& client, std::vector<Instance>& instances) const;
  Mechanics mechanicsOf(const std::vector<PlacedShapes>& lists, const SceneParts& parts) const;

  const BaseScene& base_;
  std::shared_ptr<const Snapshot> shown_;
  std::int64_t begin_ns_ = 0;
  std::int64_t making_ns_ = 0;  // what the last one took
};

}  // namespace hl
