// In a browser, in the place of src/bodies/hull_faces.cpp.
#include "bodies/hull_faces.h"

#include "base/error.h"
#include "kept_hulls.h"

namespace hl {

HullFaces hullFaces(const std::vector<Vec3>& points) {
  std::optional<HullFaces> hull = keptHull(keptHulls(), points);
  if (!hull) throw Error("hulls of bodies are made by a server only");
  return *std::move(hull);
}

std::vector<HalfSpace> unitHullPlanes(const std::vector<Vec3>&) {
  throw Error("a browser has no hulls of any points: a piece that is not convex counts as its hull");
}

}  // namespace hl
