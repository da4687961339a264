// Kept lists: what a scene was made from, which it keeps alive so that its instances are counted as long as it is
// there.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scene/placed_shape.h"

namespace hl {

/// Joints of all lists, after those that there are.
inline void addJoints(const std::vector<PlacedShapes>& lists, Mechanics& mechanics) {
  for (const PlacedShapes& list : lists) {
    if (list) mechanics.joints.insert(mechanics.joints.end(), list->joints.begin(), list->joints.end());
  }
}

/// The same scene; its lists go with its last owner.
inline std::shared_ptr<const Snapshot> keeping(std::vector<PlacedShapes> lists, std::shared_ptr<const Snapshot> scene) {
  using Both = std::pair<std::vector<PlacedShapes>, std::shared_ptr<const Snapshot>>;
  const auto both = std::make_shared<const Both>(std::move(lists), std::move(scene));
  return {both, both->second.get()};
}

}  // namespace hl
