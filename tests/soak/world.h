// A world of the long run: rooms of one kind, at some scale and place, with or without surface effects.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/primitive.h"
#include "proxy/proxy.h"
#include "soak/rooms.h"

namespace hl::soak {

inline constexpr std::array<const char*, 6> kKinds{"soup", "plates", "slots", "corners", "roughs", "apexes"};

struct World {
  Rooms rooms;          ///< in radii, in a frame of its own
  Placement placement;  ///< from there to the world
  ProxySettings settings;
  std::vector<Primitive> primitives;  ///< of the world, for the judge
  std::shared_ptr<const Snapshot> snapshot;

  Vec3 toWorld(const Vec3& p) const { return placement.linear * p + placement.offset; }
  Vec3 toRooms(const Vec3& p_W) const;
};

/// Half of them upright at r = 1 mm about the origin, the others turned, from a micrometre to a metre, and at up to
/// 10 000 radii from the origin; two thirds with the effects of surfaces.
World makeWorld(test::Random& random, std::size_t kind);

}  // namespace hl::soak
