#include "soak/world.h"

#include <cmath>
#include <utility>

#include "soak/primitives_of.h"

namespace hl::soak {

namespace {

constexpr double kUsualRadius = 1e-3;

// Normals that have nothing to do with the triangles, and numbers and textures of every quantity.
void dress(test::Random& random, Model& model) {
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    model.normals.push_back(random.below(10) == 0 ? Vec3(Vec3::Zero()) : random.direction());
    model.texcoords.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2));
  }
  Material& material = model.materials[0];
  material.stiffness = random.uniform(0, 1);
  material.smooth = random.below(4) != 0;
  if (random.below(2) == 0) {
    material.dynamic_friction = random.uniform(0, 1);
    material.static_friction = material.dynamic_friction * random.uniform(1, 2);
    material.viscosity_Ns_m = random.below(2) == 0 ? 0 : random.uniform(0, 20);
    material.stribeck_m_s = random.below(2) == 0 ? 0 : random.uniform(0, 0.1);
    material.presliding_N_m = random.below(2) == 0 ? 0 : random.uniform(0, 1e4);
  }
  if (random.below(2) == 0) return;
  model.textures = {makeTexture("noise", 32), makeTexture("checker", 32), makeTexture("sine", 32)};
  material.textureOf(Quantity::kStiffness) = {0, 0, 1};
  material.textureOf(Quantity::kStaticFriction) = {1, 0, 1};
  material.textureOf(Quantity::kHeight) = {2, 0, 0.1 * kUsualRadius};
}

void chooseRules(test::Random& random, ProxySettings& settings) {
  constexpr std::array kLedgers{LedgerMode::kTank, LedgerMode::kStrict, LedgerMode::kReport};
  settings.shading = random.below(2) == 0 ? ShadingPasses::kConverged : ShadingPasses::kOnce;
  settings.ledger = kLedgers[static_cast<std::size_t>(random.below(3))];
}

Placement choosePlacement(test::Random& random) {
  const double scale = std::pow(10.0, random.uniform(-3, 3));
  const Mat3 turned = Eigen::AngleAxisd(random.uniform(0, M_PI), random.direction()).toRotationMatrix();
  const double away = random.below(2) == 0 ? 0 : std::pow(10.0, random.uniform(0, 4));
  return {scale * kUsualRadius * turned, scale * kUsualRadius * random.inCube(away)};
}

Rooms makeRooms(test::Random& random, std::size_t kind) {
  constexpr std::array kMakers{makeSoup, makePlates, makeSlots, makeCorners, makeRoughs, makeApexes};
  return kMakers[kind](random);
}

}  // namespace

Vec3 World::toRooms(const Vec3& p_W) const {
  const Vec3 scaled = placement.linear.transpose() * (p_W - placement.offset);
  return scaled / (settings.radius * settings.radius);
}

World makeWorld(test::Random& random, std::size_t kind) {
  World world;
  world.rooms = makeRooms(random, kind);
  world.placement.linear *= kUsualRadius;
  if (random.below(2) == 0) world.placement = choosePlacement(random);
  world.settings.radius = world.placement.linear.col(0).norm();
  world.settings.world_per_device = world.settings.radius / kUsualRadius;
  if (random.below(3) != 0) {
    dress(random, world.rooms.model);
    chooseRules(random, world.settings);
  }
  Model placed = world.rooms.model;
  placeModel(placed, world.placement);
  world.primitives = primitivesOf(placed);
  world.snapshot = makeSnapshot(std::move(placed));
  return world;
}

}  // namespace hl::soak
