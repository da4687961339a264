// StillScene: a scene for threads that do not tick. Its bodies stand where the loop that steps them has shown them
// last, while that loop goes on moving them.
#pragma once

#include <memory>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// Of one thread, never a real-time one.
class StillScene {
 public:
  /// `scene`, whose bodies stand where they are now; valid until the next call. A copy of its lists is made when
  /// another scene is given; the shapes are shared.
  const Snapshot& of(const std::shared_ptr<const Snapshot>& scene);
  /// Keeps no scene until it is asked again.
  void clear();

 private:
  void copy(const Snapshot& scene);

  std::shared_ptr<const Snapshot> scene_;
  std::unique_ptr<Snapshot> copy_;                    // null: no body of it moves
  std::vector<std::shared_ptr<BodyPoses>> standing_;  // of the copy's bodies, in their order
};

}  // namespace hl
