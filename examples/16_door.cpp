// What holds bodies together, made by calls: a door with a latch, a button that clicks and a rocker switch. The program
// reads the door's angle, how far the button is pressed, and on which side the switch is.
//
//   16_door [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

namespace {

constexpr HLuint kWall = 1, kDoor = 2, kButton = 3, kRocker = 4;       // objects
constexpr HLuint kDoorHinge = 1, kButtonSlider = 2, kRockerHinge = 3;  // joints
constexpr double kDoorHalf_m = 0.03, kButtonX_m = 0.045, kRockerX_m = 0.08;

void drawBox(double x, double y, double z) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  const hl::PrimitiveScope quads(HL_QUADS);
  for (const auto& face : kFaces) {
    for (const int corner : face)
      hlVertex3d((corner & 1) != 0 ? x : -x, (corner & 2) != 0 ? y : -y, (corner & 4) != 0 ? z : -z);
  }
}

void defineBody(HLuint object, double mass_kg, double x, double y, double z) {
  const hl::ObjectScope body(object);
  hlBodyi(HL_BODY_SHAPE, HL_BODY_BOX);
  hlBodyd(HL_BODY_MASS, mass_kg);
  drawBox(x, y, z);
}

void defineObjects() {
  {
    const hl::ObjectScope wall(kWall);
    drawBox(0.04, 0.04, 0.002);
  }
  defineBody(kDoor, 0.2, kDoorHalf_m, 0.04, 0.002);
  defineBody(kButton, 0.01, 0.01, 0.01, 0.006);
  defineBody(kRocker, 0.01, 0.008, 0.015, 0.004);
}

// Hinged at its left edge; a spring closes it. The table is the latch, which holds it with up to 0.05 N m.
void drawDoor() {
  const hl::MatrixScope matrix;
  hlTranslated(-0.06, 0, 0);
  hlJointi(HL_JOINT_KIND, HL_JOINT_HINGE);
  hlJoint3d(HL_JOINT_ANCHOR, -kDoorHalf_m, 0, 0);
  hlJoint3d(HL_JOINT_AXIS, 0, 1, 0);
  hlJointd(HL_JOINT_LOW, 0);
  hlJointd(HL_JOINT_HIGH, 1.6);         // rad
  hlJointd(HL_JOINT_SPRING, 0.03);      // N m/rad
  hlJointd(HL_JOINT_DAMPING, 0.003);    // N m s/rad
  hlJointd(HL_JOINT_FRICTION, 0.0005);  // N m
  const std::array<double, 4> angles{0, 0.03, 0.06, 0.07}, torques{0, -0.05, -0.05, 0};
  hl::jointTable(angles, torques);
  hlCallObject(kDoor);
  hlJoin(kDoorHinge, kDoor, 0, 0, 0);
}

// Its way is -4 mm when it is pressed; at -2 mm the force falls from 1.2 to 0.5 N: it clicks.
void drawButton() {
  const hl::MatrixScope matrix;
  hlTranslated(kButtonX_m, 0, 0);
  hlJointi(HL_JOINT_KIND, HL_JOINT_SLIDER);
  hlJoint3d(HL_JOINT_AXIS, 0, 0, 1);
  hlJointd(HL_JOINT_LOW, -0.004);
  hlJointd(HL_JOINT_HIGH, 0);
  hlJointd(HL_JOINT_DAMPING, 0.5);
  const std::array<double, 4> ways{-0.004, -0.0022, -0.0018, 0}, forces{1.6, 0.5, 1.2, 0.3};
  hl::jointTable(ways, forces);
  hlCallObject(kButton);
  hlJoin(kButtonSlider, kButton, 0, 0, 0);
}

// It tips about its middle, and rests at 0.2 rad to either side.
void drawRocker() {
  const hl::MatrixScope matrix;
  hlTranslated(kRockerX_m, 0, 0);
  hlJointi(HL_JOINT_KIND, HL_JOINT_HINGE);
  hlJoint3d(HL_JOINT_ANCHOR, 0, 0, 0);
  hlJoint3d(HL_JOINT_AXIS, 1, 0, 0);
  hlJointd(HL_JOINT_LOW, -0.2);
  hlJointd(HL_JOINT_HIGH, 0.2);
  hlJointd(HL_JOINT_DAMPING, 0.0002);
  const std::array<double, 4> angles{-0.2, -0.1, 0.1, 0.2}, torques{-0.004, -0.008, 0.008, 0.004};
  hl::jointTable(angles, torques);
  hlCallObject(kRocker);
  hlJoin(kRockerHinge, kRocker, 0, 0, 0);
}

void draw() {
  const hl::MatrixScope all;
  {
    const hl::MatrixScope matrix;
    hlTranslated(0.06, 0, -0.02);
    hlCallObject(kWall);
  }
  drawDoor();
  drawButton();
  drawRocker();
}

// Nobody holds the simulated device of inproc:, so the program moves its hand: in turn it pushes the door open, presses
// the button, and presses the two ends of the switch.
void moveHand(double t) {
  const double phase = std::fmod(t, 8), press = 0.5 * (1 - std::cos(M_PI * phase));  // 0 .. 1, one press in 2 s
  if (phase < 2) return hlHandGoal3d(-0.04, 0, 0.02 - 0.06 * press);
  if (phase < 4) return hlHandGoal3d(kButtonX_m, 0, 0.02 - 0.05 * press);
  hlHandGoal3d(kRockerX_m, phase < 6 ? 0.012 : -0.012, 0.02 - 0.03 * press);
}

void print(double t) {
  std::printf("%5.1f s", t);
  for (const HLjoint& joint : hl::joints()) {
    if (joint.joint == kDoorHinge) std::printf("  door %5.1f degrees", std::abs(joint.coordinate) * 180 / M_PI);
    if (joint.joint == kButtonSlider)
      std::printf("  button %4.2f mm, %4.2f N", std::abs(1e3 * joint.coordinate), joint.force);
    if (joint.joint == kRockerHinge) std::printf("  switch %s", joint.coordinate > 0 ? "on" : "off");
  }
  const auto force = hl::get<3>(HL_FORCE);
  std::printf("  hand %5.2f N\n", std::hypot(force[0], force[1], force[2]));
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  const hl::Context context(url);
  hlWorkspaced(0, 0, 0, 1);
  hlGravity3d(0, -9.81, 0);
  defineObjects();
  draw();
  hlFinish();
  hl::check();
  for (int i = 0; i < 60 * seconds; ++i) {
    const double t = i / 60.0;
    if (url.starts_with("inproc:")) moveHand(t);
    hlPoll();
    if (i % 15 == 0) print(t);
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "16_door: %s\n", error.what());
  return 2;
}
