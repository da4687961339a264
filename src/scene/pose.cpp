#include "scene/pose.h"

namespace hl {

Box boxAt(const Box& object, const Pose& pose) {
  if (object.empty() || pose == Pose{}) return object;
  const Vec3 centre = pose.toWorld(object.centre());
  const Vec3 half = pose.rotation.cwiseAbs() * (0.5 * object.size());
  Box box;
  box.extend(centre - half);
  box.extend(centre + half);
  return box;
}

}  // namespace hl
