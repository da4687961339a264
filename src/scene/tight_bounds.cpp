#include "scene/tight_bounds.h"

#include "geometry/tight_box.h"

namespace hl {

Box tightBounds(const Snapshot& snapshot) {
  Box bounds;
  for (const Instance& instance : snapshot.instances) {
    const Shape& shape = *instance.shape;
    const Pose pose = instance.shownAt(snapshot.moves_until_ns);
    if (!shape.source) {
      const Box box = boxAt(shape.bounds, pose);
      if (!box.empty()) bounds.extend(box);
    } else if (const Box box = tightBox(*shape.source, *shape.index, pose.rotation); !box.empty()) {
      bounds.extend(Box{box.min + pose.origin, box.max + pose.origin});
    }
  }
  return bounds;
}

}  // namespace hl
