#include "session/check_bodies.h"

#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "bodies/scene_world.h"
#include "geometry/primitive.h"

namespace hl {

namespace {

using Checked = std::set<std::pair<const Shape*, const BodySpec*>>;

void check(const PlacedShape& placed) {
  const Box bounds = placed.shape->model.bounds();
  if (!withinReach(bounds.min) || !withinReach(bounds.max)) throw Error("its vertices must lie within 1e9 m");
  bodyOf(placed.shape->model, *placed.body);
}

}  // namespace

std::size_t checkBodies(const std::vector<PlacedShape>& placed, const std::vector<PlacedShape>& before) {
  Checked good;
  for (const PlacedShape& one : before) {
    if (one.movesAsBody()) good.emplace(one.shape.get(), one.body.get());
  }
  std::size_t count = 0;
  for (const PlacedShape& one : placed) {
    if (!one.movesAsBody()) continue;
    ++count;
    if (!good.emplace(one.shape.get(), one.body.get()).second) continue;
    try {
      check(one);
    } catch (const Error& error) {
      throw Error("object " + std::to_string(one.object) + ".body: " + error.what());
    }
  }
  return count;
}

}  // namespace hl
