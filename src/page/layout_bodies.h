// LayoutBodies: the rigid bodies and joints of a layout, so that a page can save the scene as a scene file.
#pragma once

#include <hl.pb.h>

#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// What a layout describes of the bodies of a snapshot.
struct LayoutBodies {
  std::vector<std::shared_ptr<const RigidBody>> bodies;  ///< one for each instance; null: it has no mass
  Mechanics mechanics;

  static LayoutBodies of(const Snapshot& snapshot);
  /// Whether pages would be sent the same.
  bool operator==(const LayoutBodies& other) const;
};

/// `contents` are of this snapshot, and the placed meshes of `layout` are its instances.
void addBodies(const LayoutBodies& contents, const Snapshot& snapshot, proto::SceneLayout& layout);

}  // namespace hl
