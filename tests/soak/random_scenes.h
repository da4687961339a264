// Small random scenes of every kind that has gone wrong somewhere: slivers, needles, cones, slots, cages, shells within
// shells, points, segments, coincident faces; of any size, anywhere, with any effect of surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/primitive.h"
#include "geometry/scenes.h"
#include "proxy/proxy.h"

namespace hl::soak {

/// Which rules of surfaces there are, and with them what must hold.
enum class Effect : std::uint8_t { kNone, kStiffness, kFriction, kShading, kEverything };

struct RandomScene {
  std::string what;  ///< kind, for messages
  Effect effect = Effect::kNone;
  double stiffness = 1;  ///< of all surfaces, but with Effect::kEverything
  double static_friction = 0;
  double half = 0;               ///< radii; the scene lies about within -half..half of the centre
  Vec3 centre_W = Vec3::Zero();  ///< m
  ProxySettings settings;
  std::vector<Primitive> primitives;                   ///< in the world
  std::vector<std::array<Vec3, 3>> solid;              ///< triangles that make closed surfaces, each wound alike
  std::shared_ptr<const Snapshot> snapshot, shuffled;  ///< the same in another order and with another index
};

RandomScene drawScene(test::Random& random);

/// The ledger and the limit of work.
void drawRules(test::Random& random, RandomScene& scene);
/// The material of an effect, but for shading and textures.
void dress(test::Random& random, RandomScene& scene, Material& material);

}  // namespace hl::soak
