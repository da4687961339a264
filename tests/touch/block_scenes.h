// Block scenes: rigid blocks above a floor.
#pragma once

#include <memory>
#include <vector>

#include "bodies/test_worlds.h"
#include "proxy/effect_scenes.h"
#include "scene/rigid_body.h"

namespace hl::test {

struct Block {
  double mass_kg = 0.1;
  Vec3 half = Vec3::Constant(0.02);
  Vec3 at = Vec3(0, 0.02, 0);
  std::uint64_t key = 0;
};

/// Blocks without a key have those from 2 on.
inline std::shared_ptr<const Snapshot> sceneOfBlocks(const std::vector<Block>& blocks, double friction,
                                                     double gravity_m_s2, std::uint64_t number = 1) {
  const BodySurface surface{friction, friction, 0};
  const Box room{Vec3::Constant(-10), Vec3::Constant(10)};
  std::vector<Instance> instances{instanceOf(floorModel(), 1)};
  BodySpec floor;
  floor.fixed = true;
  floor.surface = surface;
  instances.back().body = makeRigidBody("floor", floor, {}, {}, room);
  for (const Block& block : blocks) {
    instances.push_back(instanceOf(boxModel(block.half), block.key != 0 ? block.key : instances.size() + 1));
    Instance& instance = instances.back();
    BodySpec spec;
    spec.mass_kg = block.mass_kg;
    spec.shape = BodyShape::kBox;
    spec.surface = surface;
    instance.body = makeRigidBody("block", spec, {Mat3::Identity(), block.at}, instance.shape->bounds, room);
    instance.driver = instance.body->poses;
  }
  return makeSnapshot(std::move(instances), {}, number, 0, {Vec3(0, -gravity_m_s2, 0), {}});
}

}  // namespace hl::test
