// Bullet in double precision, with its usual solver; bodies never sleep, and their margin fits their size.
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "cubes/body_engine.h"

namespace hl::bench {

namespace {

constexpr double kMargin_m = 0.001;  // the usual one of 40 mm is as large as the cubes

btVector3 bulletOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vecOf(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

class BulletBodies final : public BodyEngine {
 public:
  explicit BulletBodies(const CubeScene& scene)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        cube_(btVector3(kCubeHalf_m, kCubeHalf_m, kCubeHalf_m)),
        friction_(std::sqrt(scene.friction)) {
    world_.setGravity({0, -kEarth_m_s2, 0});
    cube_.setMargin(kMargin_m);
    addPlane(Vec3::UnitY(), 0);
    for (const double side : {-1.0, 1.0}) {
      if (!(scene.walls_m > 0)) continue;
      addPlane(side * Vec3::UnitX(), -scene.walls_m);
      addPlane(side * Vec3::UnitZ(), -scene.walls_m);
    }
    for (const Pose& pose : scene.cubes) addCube(pose);
  }
  ~BulletBodies() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletBodies(const BulletBodies&) = delete;
  BulletBodies& operator=(const BulletBodies&) = delete;

  double step(double finger_m) override {
    const double force_N = pushOf_N(finger_m, cube(0));
    bodies_[planes_]->applyCentralForce({force_N, 0, 0});
    world_.stepSimulation(kBodyStep_s, 1, kBodyStep_s);
    return force_N;
  }
  CubeState cube(std::size_t i) const override {
    const btRigidBody& body = *bodies_[planes_ + i];
    CubeState state;
    state.centre = vecOf(body.getCenterOfMassPosition());
    const btMatrix3x3& turn = body.getCenterOfMassTransform().getBasis();
    for (int row = 0; row < 3; ++row) state.turned.row(row) = vecOf(turn[row]);
    state.velocity = vecOf(body.getLinearVelocity());
    state.spin = vecOf(body.getAngularVelocity());
    return state;
  }

 private:
  // Friction of two is the product.
  void add(double mass_kg, btCollisionShape& shape, const btVector3& inertia, const btTransform& pose) {
    btRigidBody::btRigidBodyConstructionInfo info(mass_kg, nullptr, &shape, inertia);
    info.m_startWorldTransform = pose;
    info.m_friction = friction_;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }
  void addPlane(const Vec3& normal, double at_m) {
    shapes_.push_back(std::make_unique<btStaticPlaneShape>(bulletOf(normal), at_m));
    shapes_.back()->setMargin(0);
    add(0, *shapes_.back(), {0, 0, 0}, btTransform::getIdentity());
    ++planes_;
  }
  void addCube(const Pose& pose) {
    btVector3 inertia;
    cube_.calculateLocalInertia(kCube_kg, inertia);
    btTransform at(btTransform::getIdentity());
    at.setOrigin(bulletOf(pose.origin));
    const Mat3& r = pose.rotation;
    at.setBasis({r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)});
    add(kCube_kg, cube_, inertia, at);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btBoxShape cube_;
  double friction_;
  std::size_t planes_ = 0;
  std::vector<std::unique_ptr<btStaticPlaneShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // planes, then cubes
};

}  // namespace

std::unique_ptr<BodyEngine> makeBulletBodies(const CubeScene& scene) { return std::make_unique<BulletBodies>(scene); }

}  // namespace hl::bench
