// Scenes whose free space falls into rooms that are known by formula: no sphere of radius one that keeps clear of the
// surfaces can go from one room to another, so a proxy that is suddenly in another room has fallen through.
// Lengths are in radii of the proxy.
#pragma once

#include <functional>
#include <vector>

#include "geometry/scenes.h"
#include "scene/model.h"

namespace hl::soak {

struct Rooms {
  Model model;
  Vec3 half = Vec3::Zero();                ///< the model lies in about -half..half
  std::function<int(const Vec3& p)> room;  ///< in which room the centre of a clear sphere is
  std::vector<Vec3> marks{};               ///< places that the finger looks for
};

/// A closed box of triangles that gape and cross, some missing, among random triangles, segments and points.
Rooms makeSoup(test::Random& random);
/// A closed box in layers of sheets without thickness, from coincident to far apart, and plates with free edges.
Rooms makePlates(test::Random& random);
/// A closed box over grooves and over channels about as wide as the proxy.
Rooms makeSlots(test::Random& random);
/// A closed box over an egg-box, with needles, segments and points standing about.
Rooms makeCorners(test::Random& random);

/// A closed box over a terrain with detail of every size, from the box down to a part of the proxy.
Rooms makeRoughs(test::Random& random);
/// A closed box with one vertex or edge that many share: a cone, funnel, fan, needle, star of segments, or triangles
/// about one edge; marked.
Rooms makeApexes(test::Random& random);

}  // namespace hl::soak
