// What a finger feels of joints that a program has made: the frames go through the calls and a server; the finger
// presses on the scene that comes out, on a virtual clock. Numbers R11 and R12 are those of docs/bodies.md.
#include <gtest/gtest.h>
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "felt_server.h"
#include "scene/scene_model.h"
#include "touch/body_world.h"
#include "touch/plain_servo.h"
#include "touch/touch_step.h"
#include "wait_for.h"

namespace hl::client::test_felt_joints {
namespace {

constexpr double kStep_s = 1e-3, kRadius_m = 0.001, kSpring_N_m = 1000;
constexpr HLuint kDoor = 1, kButton = 2, kJoint = 5;

void drawBox(double x, double y, double z) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  hlBegin(HL_QUADS);
  for (const auto& face : kFaces) {
    for (const int corner : face)
      hlVertex3d((corner & 1) != 0 ? x : -x, (corner & 2) != 0 ? y : -y, (corner & 4) != 0 ? z : -z);
  }
  hlEnd();
}

void defineBody(HLuint object, double mass_kg, double x, double y, double z) {
  hlNewObject(object);
  hlBodyd(HL_BODY_MASS, mass_kg);
  hlBodyi(HL_BODY_SHAPE, HL_BODY_BOX);
  hlBodyd(HL_BODY_DYNAMIC_FRICTION, 0);
  drawBox(x, y, z);
  hlEndObject();
}

// Of 1 kg, hinged along z at the world's x axis.
void drawDoor() {
  defineBody(kDoor, 1, 0.002, 0.16, 0.1);
  hlGravity3d(0, 0, 0);
  hlPushMatrix();
  hlTranslated(0.002, 0, 0);
  hlJointi(HL_JOINT_KIND, HL_JOINT_HINGE);
  hlJoint3d(HL_JOINT_ANCHOR, 0, 0, 0);
  hlJoint3d(HL_JOINT_AXIS, 0, 0, 1);
  hlJointd(HL_JOINT_FRICTION, 0.05);
  hlTranslated(0, 0.16, 0);
  hlCallObject(kDoor);
  hlPopMatrix();
  hlJoin(kJoint, kDoor, 0, 0, 0);
}

// Of 20 g, its face at x = 0.
void drawButton() {
  defineBody(kButton, 0.02, 0.01, 0.01, 0.01);
  hlGravity3d(0, 0, 0);
  hlPushMatrix();
  hlTranslated(0.01, 0, 0);
  hlCallObject(kButton);
  hlPopMatrix();
  hlJointi(HL_JOINT_KIND, HL_JOINT_SLIDER);
  hlJoint3d(HL_JOINT_AXIS, 1, 0, 0);
  hlJointd(HL_JOINT_SPRING, 200);
  hlJointd(HL_JOINT_DAMPING, 1);
  hlJoin(kJoint, kButton, 0, 0, 0);
}

// A device's finger on that scene.
class Finger {
 public:
  explicit Finger(const std::shared_ptr<const Snapshot>& scene) : scenes_(scene), loop_(scenes_, ProxySettings{}) {
    arm(step_.servo());
    commands_.radius_W = kRadius_m;
  }

  /// From `from` to x = `to` in this time, then held; the last force.
  Vec3 push(const Vec3& from, double to, double seconds, double held_s) {
    Vec3 finger = from, force = Vec3::Zero();
    for (double t = kStep_s; t < seconds + held_s; t += kStep_s) {
      finger.x() = from.x() + (to - from.x()) * std::min(1.0, t / seconds);
      DeviceSample sample;
      sample.time_ns = time_ns_ += 1'000'000;
      sample.position = finger;
      sample.status = DeviceStatus::kOk;
      force = step_.onTime(loop_, commands_, settings_, sample).force_N;
    }
    return force;
  }
  const JointState& joint() const { return scenes_.bodies()->state().joints[0]; }

 private:
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  TouchStep step_;
  ServoSettings settings_ = test::plainServo(kSpring_N_m, kStep_s);
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
};

class FeltJoints : public test::FeltServer {
 protected:
  /// With bodies that the server's loop does not move.
  std::shared_ptr<const Snapshot> shown() { return withOwnBodies(*FeltServer::shown()); }
  static double valueOf(HLenum name) {
    HLdouble value = HUGE_VAL;
    hlPoll();
    hlGetJointdv(kJoint, name, &value);
    return value;
  }
  /// Waits until it is sent a value for which this holds.
  static void awaitValue(HLenum name, const std::function<bool(double)>& holds) {
    test::waitFor([&] { return holds(valueOf(name)); });
  }
};

TEST_F(FeltJoints, R11TheFrictionOfADoor) {
  drawDoor();
  const auto scene = shown();
  for (const auto& [r, force_N] : {std::pair{0.3, 0.05 / 0.3}, std::pair{0.15, 0.05 / 0.15}}) {
    Finger finger(withOwnBodies(*scene));
    const Vec3 force = finger.push(Vec3(-0.002, r, 0), 0.001, 20, 0);
    EXPECT_NEAR(-force.x(), force_N, 1e-3 * force_N) << r;
    EXPECT_LT(finger.joint().velocity, -1e-4);
  }
}

TEST_F(FeltJoints, R12AButtonInSeriesWithTheSpring) {
  drawButton();
  Finger finger(shown());
  const Vec3 force = finger.push(Vec3(-0.002, 0, 0), 0.006 - kRadius_m, 1, 0.8);
  EXPECT_NEAR(-force.x(), 1.000, 1e-6);
  EXPECT_NEAR(finger.joint().coordinate, 0.005, 1e-8);
}

// P at the edge gives the door L = P 0.32 m; with I = m (0.32 m)^2 / 3 its friction M stops it after L^2 / 2 I M. It is
// out of the hand's way.
TEST_F(FeltJoints, AProgramReadsAnAngleThatStaysWhileFramesDrawTheDoorAgain) {
  hlStateRate(1000);
  hlTranslated(0.5, 0, 0);
  drawDoor();
  ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
  awaitValue(HL_JOINT_COORDINATE, [](double angle) { return angle == 0; });
  hlBodyImpulsed(kDoor, 0.1, 0, 0, 0.5, 0.32, 0, 0);
  awaitValue(HL_JOINT_VELOCITY, [](double velocity) { return velocity < 0; });
  awaitValue(HL_JOINT_VELOCITY, [](double velocity) { return velocity == 0; });
  const double angle = valueOf(HL_JOINT_COORDINATE);
  EXPECT_NEAR(angle, -0.3, 0.003);
  for (int frame = 0; frame < 10; ++frame) {
    drawDoor();
    ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
    EXPECT_NEAR(valueOf(HL_JOINT_COORDINATE), angle, 1e-9);
  }
}

}  // namespace
}  // namespace hl::client::test_felt_joints
