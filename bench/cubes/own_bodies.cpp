#include "bodies/body_step.h"
#include "cubes/body_engine.h"

namespace hl::bench {

namespace {

// The floor, and walls of this height.
std::shared_ptr<const Snapshot> trayOf(const CubeScene& scene) {
  constexpr double kHeight_m = 2;
  const double half_m = scene.walls_m > 0 ? scene.walls_m : 1;
  Model model;
  for (const double y : {0.0, kHeight_m}) {
    for (const auto& [x, z] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}})
      model.positions.emplace_back(half_m * x, y, half_m * z);
  }
  model.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (std::uint32_t i = 0; i < 4 && scene.walls_m > 0; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    model.triangles.push_back({i, next, next + 4});
    model.triangles.push_back({i, next + 4, i + 4});
  }
  return makeSnapshot(std::move(model));
}

World worldOf(const CubeScene& scene) {
  const Vec3 half = Vec3::Constant(kCubeHalf_m);
  World world;
  world.fixed = trayOf(scene);
  for (std::size_t i = 0; i < scene.cubes.size(); ++i)
    world.bodies.push_back({i + 1, massOfBox(kCube_kg, half), boxShape(half), {scene.friction, scene.friction, 0}});
  return world;
}

class OwnBodies final : public BodyEngine {
 public:
  explicit OwnBodies(const CubeScene& scene)
      : world_(std::make_shared<const World>(worldOf(scene))),
        state_(startWorld(*world_, scene.cubes)),
        stepper_(world_),
        pushed_(scene.finger_m_s > 0) {}

  double step(double finger_m) override {
    if (!pushed_) {
      stepper_.step(state_, kBodyStep_s, {}, {});
      return 0;
    }
    const Vec3 face = faceOfFirst();
    HandNode hand;
    hand.proxy = Vec3(std::min(face.x(), finger_m), face.y(), face.z());
    hand.stretch = Vec3(hand.proxy.x() - finger_m, 0, 0);
    hand.spring_N_m = kPushSpring_N_m;
    if (finger_m >= face.x()) hand.contacts.push({1, hand.proxy, -Vec3::UnitX(), 0, 0, false});
    GivenImpulses given;
    stepper_.step(state_, kBodyStep_s, std::span(&hand, 1), std::span(&given, 1));
    double impulse_N_s = 0;
    for (const BodyImpulse& one : given) impulse_N_s += one.key == 0 ? 0 : one.impulse_N_s.x();
    return impulse_N_s / kBodyStep_s;
  }
  CubeState cube(std::size_t i) const override {
    const BodyState& body = state_.bodies[i];
    return {body.centre, body.turned.toRotationMatrix(), body.velocity, body.spin};
  }

 private:
  Vec3 faceOfFirst() const { return state_.bodies[0].centre - kCubeHalf_m * Vec3::UnitX(); }

  std::shared_ptr<const World> world_;
  WorldState state_;
  BodyStepper stepper_;
  bool pushed_;
};

}  // namespace

std::unique_ptr<BodyEngine> makeOwnBodies(const CubeScene& scene) { return std::make_unique<OwnBodies>(scene); }

}  // namespace hl::bench
