// The triangles, lines and points of a model, for judges.
#pragma once

#include <vector>

#include "geometry/make_primitive.h"
#include "geometry/primitive.h"
#include "scene/model.h"

namespace hl::soak {

// As a shape leaves out what is degenerate, so does the judge.
inline std::vector<Primitive> primitivesOf(const Model& model) {
  std::vector<Primitive> primitives;
  Primitive made;
  const auto& at = model.positions;
  for (const auto& t : model.triangles) {
    if (makeTriangle(at[t[0]], at[t[1]], at[t[2]], 0, made)) primitives.push_back(made);
  }
  for (const auto& s : model.segments) {
    if (test::makeSegment(at[s[0]], at[s[1]], 0, made)) primitives.push_back(made);
  }
  for (const auto p : model.points) {
    if (test::makePoint(at[p], 0, made)) primitives.push_back(made);
  }
  return primitives;
}

}  // namespace hl::soak
