#include "tick/feel.h"

#include <utility>

namespace hl::bench {

namespace {

Material materialOf(Feel feel) {
  Material material;
  if (feel == Feel::kShading || feel == Feel::kEverything) material.smooth = true;
  if (feel == Feel::kFriction || feel == Feel::kEverything) {
    material.static_friction = 0.5;
    material.dynamic_friction = 0.3;
    material.viscosity_Ns_m = 2;
  }
  if (feel == Feel::kEverything) {
    material.textureOf(Quantity::kStiffness) = {0, 0.5, 1};
    material.textureOf(Quantity::kStaticFriction) = {1, 0.3, 0.6};
    material.textureOf(Quantity::kHeight) = {2, 0, 1e-4};
  }
  return material;
}

}  // namespace

const char* nameOf(Feel feel) {
  constexpr std::array<const char*, kFeels.size()> kNames{"plain", "shading", "friction", "everything"};
  return kNames[static_cast<std::size_t>(feel)];
}

std::shared_ptr<const Snapshot> makeSnapshotOf(std::shared_ptr<const Shape> shape, Feel feel) {
  auto surfaces = std::make_shared<Surfaces>();
  surfaces->materials.assign(shape->model.materials.size(), materialOf(feel));
  if (feel == Feel::kEverything) {
    for (const char* kind : {"noise", "checker", "sine"}) {
      surfaces->textures.push_back(std::make_shared<const Texture>(makeTexture(kind, 64)));
    }
  }
  Instance instance;
  instance.shape = std::move(shape);
  instance.surfaces = std::move(surfaces);
  std::vector<Instance> instances;
  instances.push_back(std::move(instance));
  return makeSnapshot(std::move(instances));
}

}  // namespace hl::bench
