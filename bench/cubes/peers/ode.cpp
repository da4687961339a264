// ODE, as its manual has it: contacts of a box, friction as a pyramid, ERP and CFM as they are.
#include <ode/ode.h>

#include <array>

#include "cubes/body_engine.h"

namespace hl::bench {

namespace {

using OdeStep = int (*)(dWorldID, dReal);

class OdeBodies final : public BodyEngine {
 public:
  OdeBodies(const CubeScene& scene, OdeStep how) : step_(how), friction_(scene.friction) {
    dInitODE();
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0, -kEarth_m_s2, 0);
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dCreatePlane(space_, 0, 1, 0, 0);
    for (const int side : {-1, 1}) {
      if (!(scene.walls_m > 0)) continue;
      dCreatePlane(space_, side, 0, 0, -scene.walls_m);
      dCreatePlane(space_, 0, 0, side, -scene.walls_m);
    }
    for (const Pose& pose : scene.cubes) addCube(pose);
  }
  ~OdeBodies() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeBodies(const OdeBodies&) = delete;
  OdeBodies& operator=(const OdeBodies&) = delete;

  double step(double finger_m) override {
    const double force_N = pushOf_N(finger_m, cube(0));
    dBodyAddForce(cubes_[0], force_N, 0, 0);
    dSpaceCollide(space_, this, &OdeBodies::meet);
    step_(world_, kBodyStep_s);
    dJointGroupEmpty(contacts_);
    return force_N;
  }
  CubeState cube(std::size_t i) const override {
    const dReal *at = dBodyGetPosition(cubes_[i]), *turn = dBodyGetRotation(cubes_[i]);
    const dReal *velocity = dBodyGetLinearVel(cubes_[i]), *spin = dBodyGetAngularVel(cubes_[i]);
    CubeState state;
    for (int row = 0; row < 3; ++row) {
      state.centre[row] = at[row];
      state.velocity[row] = velocity[row];
      state.spin[row] = spin[row];
      for (int column = 0; column < 3; ++column) state.turned(row, column) = turn[4 * row + column];
    }
    return state;
  }

 private:
  void addCube(const Pose& pose) {
    constexpr double kSide_m = 2 * kCubeHalf_m;
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    dMassSetBoxTotal(&mass, kCube_kg, kSide_m, kSide_m, kSide_m);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, pose.origin.x(), pose.origin.y(), pose.origin.z());
    dMatrix3 turn{};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) turn[4 * row + column] = pose.rotation(row, column);
    }
    dBodySetRotation(body, turn);
    dGeomSetBody(dCreateBox(space_, kSide_m, kSide_m, kSide_m), body);
    cubes_.push_back(body);
  }
  static void meet(void* self, dGeomID a, dGeomID b) {
    auto& engine = *static_cast<OdeBodies*>(self);
    std::array<dContact, 16> contacts{};
    const int count = dCollide(a, b, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = engine.friction_;
      dJointAttach(dJointCreateContact(engine.world_, engine.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  OdeStep step_;
  double friction_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> cubes_;
};

}  // namespace

std::unique_ptr<BodyEngine> makeOdeBodies(const CubeScene& scene) {
  return std::make_unique<OdeBodies>(scene, dWorldQuickStep);
}

std::unique_ptr<BodyEngine> makeOdeExactBodies(const CubeScene& scene) {
  return std::make_unique<OdeBodies>(scene, dWorldStep);
}

}  // namespace hl::bench
