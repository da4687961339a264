#include "session/check_bodies.h"

#include <algorithm>
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

void checkBodiesOfAll(std::size_t all, std::size_t most, std::size_t devices) {
  if (devices > 1)
    throw Error("a server with several devices has no rigid bodies that move: give them fixed, or start one device");
  if (all > most)
    throw Error("there are more than " + std::to_string(most) +
                " bodies in the world, those of other clients among them");
}

Box boundsForBodies(const Snapshot& base, const std::vector<PlacedShape>& placed) {
  if (std::none_of(placed.begin(), placed.end(), [](const PlacedShape& one) { return one.movesAsBody(); })) return {};
  Box bounds = base.bounds;
  for (const PlacedShape& one : placed) bounds.extend(boxAt(one.shape->bounds, one.pose));
  return bounds;
}

}  // namespace hl
