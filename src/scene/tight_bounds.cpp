#include "scene/tight_bounds.h"

#include "geometry/tight_box.h"
#include "surfaces/height_field.h"

namespace hl {

Box tightBounds(const PrimitiveSource& source, const SpatialIndex& index, const Mat3& turn) {
  if (dynamic_cast<const HeightField*>(&source) == nullptr) return tightBox(source, index, turn);
  return boxAt(source.bounds(), {turn, Vec3::Zero()});
}

Box tightBounds(const Snapshot& snapshot) {
  Box bounds;
  for (const Instance& instance : snapshot.instances) {
    const Shape& shape = *instance.shape;
    const Pose pose = instance.shownAt(snapshot.moves_until_ns);
    if (!shape.source) {
      const Box box = boxAt(shape.bounds, pose);
      if (!box.empty()) bounds.extend(box);
    } else if (const Box box = tightBounds(*shape.source, *shape.index, pose.rotation); !box.empty()) {
      bounds.extend(Box{box.min + pose.origin, box.max + pose.origin});
    }
  }
  return bounds;
}

}  // namespace hl
