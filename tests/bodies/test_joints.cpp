// Joints against closed forms; numbers R9.. are those of docs/bodies.md.
#include <gtest/gtest.h>

#include <cmath>

#include "guard/realtime_guard.h"
#include "joint_worlds.h"

namespace hl::test_joints {
namespace {

using namespace test;

// A step, and whether the energy book still holds all.
void stepBooked(Playground& play, double begin_J, double scale_J) {
  play.step();
  ASSERT_NEAR(play.energy_J() - begin_J, play.state.energy.change_J(), 1e-9 * scale_J) << play.state.steps;
}

// s: the time of a whole swing, from the zeros of joint 0's coordinate.
double periodOf(Playground& play, double seconds) {
  double first = -1, last = -1, before = play.state.joints[0].coordinate;
  int swings = -1;
  for (double t = 0; t < seconds; t += play.period_s) {
    play.step();
    const double now = play.state.joints[0].coordinate;
    if (before < 0 && now >= 0) {
      last = t + play.period_s * -before / (now - before);
      if (first < 0) first = last;
      ++swings;
    }
    before = now;
  }
  return (last - first) / swings;
}

TEST(Joints, R9TheFreePeriodOfAHingedRod) {
  HingedRod rod;
  rod.angle_rad = 0.01;
  Playground play(heavy({rod.body(1)}, {rod.joint(1, 1)}), {rod.pose()});
  EXPECT_NEAR(periodOf(play, 20), 0.8971, 1e-4);
}

// The chord's velocity neither gains nor loses: over 100 s the amplitude of 1.2 rad stays.
TEST(Joints, APendulumKeepsItsEnergy) {
  HingedRod rod;
  rod.angle_rad = 1.2;
  Playground play(heavy({rod.body(1)}, {rod.joint(1, 1)}), {rod.pose()});
  double highest = 0;
  const double begin_J = play.energy_J();
  for (int i = 0; i < 100'000; ++i) {
    stepBooked(play, begin_J, 0.1);
    if (i > 99'000) highest = std::max(highest, play.state.joints[0].coordinate);
  }
  EXPECT_NEAR(highest, 1.2, 2e-3);
  EXPECT_LT(worstOff(play), 1e-9);
}

TEST(Joints, ADistanceJointIsAPendulumOfItsLength) {
  const Vec3 bob(0.01 * 0.25, -0.25, 0);
  for (const bool string : {false, true}) {
    Joint joint = named(1, 1, 0, distanceBetween(bob, Vec3::Zero(), placeAt(bob)));
    if (string) joint.low = 0;
    Playground play(heavy({ball(1, 0.05, 0.01, 0)}, {joint}), {placeAt(bob)});
    const double begin_J = play.energy_J();
    double first = -1, last = -1, x = bob.x();
    int swings = -1;
    for (int i = 0; i < 20'000; ++i) {
      stepBooked(play, begin_J, 0.1);
      const double now = play.state.bodies[0].centre.x();
      if (x < 0 && now >= 0) {
        last = (i - now / (now - x)) * kStep_s;
        if (first < 0) first = last;
        ++swings;
      }
      x = now;
      EXPECT_NEAR(play.state.bodies[0].centre.norm(), bob.norm(), 1e-9);
    }
    EXPECT_NEAR((last - first) / swings, 2 * EIGEN_PI * std::sqrt(0.25 / kGravity), 1e-4) << string;
  }
}

TEST(Joints, AChainOfTenHangsWithoutStretching) {
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Pose> poses;
  const double link = 0.03;
  const Mat3 turn = Eigen::AngleAxisd(0.5, Vec3(0.3, 0, 1).normalized()).toRotationMatrix();
  for (int i = 0; i < 10; ++i) {
    const auto key = static_cast<std::uint64_t>(i + 1);
    bodies.push_back(block(key, 0.01, Vec3(0.003, link / 2, 0.003), 0.3));
    poses.push_back({turn, turn * Vec3(0, -link * (i + 0.5), 0)});
    joints.push_back(named(key, key, key - 1,
                           jointAt(JointKind::kBall, turn * Vec3(0, -link * i, 0), Vec3::UnitX(), poses.back(),
                                   i == 0 ? Pose() : poses[static_cast<std::size_t>(i - 1)])));
  }
  Playground play(heavy(bodies, joints), poses);
  const double begin_J = play.energy_J();
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    stepBooked(play, begin_J, 0.1);
    worst = std::max(worst, worstOff(play));
  }
  EXPECT_LT(worst, 1e-6);
  RecordProperty("solver_J", std::to_string(play.state.energy.solver_J));
}

// Two blocks, fixed to each other, pushed off their middle: as one body of 300 g.
TEST(Joints, TwoFixedBodiesMoveAsOne) {
  const Vec3 half = Vec3::Constant(0.02), at_a(0.02, 0, 0), at_b(-0.02, 0, 0);
  Joint joint =
      named(1, 1, 2, jointAt(JointKind::kFixed, Vec3(0, 0.01, 0), Vec3::UnitX(), placeAt(at_a), placeAt(at_b)));
  Playground play(weightless({block(1, 0.1, half, 0), block(2, 0.2, half, 0)}, {joint}),
                  {placeAt(at_a), placeAt(at_b)});
  HandNode hand;  // it owes an impulse, and its spring is next to nothing
  hand.spring_N_m = 1e-9;
  hand.owed.push({1, Vec3(0.04, 0, 0), Vec3(0, 1e-3, 0)});
  play.step({&hand, 1});
  const double middle = (0.1 * 0.02 - 0.2 * 0.02) / 0.3;
  const double inertia = 0.3 * 0.04 * 0.04 / 6 + 0.1 * std::pow(0.02 - middle, 2) + 0.2 * std::pow(-0.02 - middle, 2);
  const double spin = 1e-3 * (0.04 - middle) / inertia, speed = 1e-3 / 0.3;
  // The chord of the step: to the square of what it turns in it.
  EXPECT_NEAR(play.state.bodies[0].spin.z(), spin, 1e-7 * spin);
  EXPECT_NEAR(play.state.bodies[1].spin.z(), spin, 1e-7 * spin);
  EXPECT_NEAR(play.state.bodies[0].velocity.y(), speed + spin * (0.02 - middle), 1e-6);
  EXPECT_NEAR(play.state.bodies[1].velocity.y(), speed + spin * (-0.02 - middle), 1e-6);
  play.steps(2000);
  EXPECT_LT(worstOff(play), 1e-9);
  EXPECT_NEAR(play.momentum().y(), 1e-3, 1e-15);
  EXPECT_NEAR(play.state.bodies[0].spin.z(), spin, 1e-6 * spin);
}

// m, at 1 m/s or 1 rad/s against a limit at 0.0503: how far beyond, and how fast back.
TEST(Joints, ALimitStopsWithoutABounce) {
  for (const JointKind kind : {JointKind::kSlider, JointKind::kHinge, JointKind::kDistance}) {
    const Vec3 at(0.1, 0, 0);
    Joint joint = kind == JointKind::kDistance
                      ? distanceBetween(at, Vec3::Zero(), placeAt(at))
                      : jointAt(kind, Vec3::Zero(),
                                kind == JointKind::kHinge ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX()), placeAt(at));
    const double begin = kind == JointKind::kDistance ? 0.1 : 0;
    joint.low = begin - 0.0301;
    joint.high = begin + 0.0503;
    Playground play(weightless({ball(1, 0.1, 0.01, 0)}, {named(1, 1, 0, joint)}), {placeAt(at)});
    double kinetic_J = 0;
    for (const double way : {1.0, -1.0}) {
      play.state.bodies[0].velocity = kind == JointKind::kHinge ? Vec3(0, 0, -way * 0.1) : Vec3(way, 0, 0);
      if (kind == JointKind::kHinge) play.state.bodies[0].spin = Vec3(0, way, 0);
      const double begin_J = play.energy_J() - play.state.energy.change_J();
      kinetic_J += play.energy_J();
      double furthest = 0;
      for (int i = 0; i < 200; ++i) {
        stepBooked(play, begin_J, 0.1);
        furthest = std::max(furthest, way * (play.state.joints[0].coordinate - (way > 0 ? joint.high : joint.low)));
      }
      EXPECT_LT(furthest, 1e-6);
      EXPECT_NEAR(play.state.joints[0].coordinate, way > 0 ? joint.high : joint.low, 1e-9);
      EXPECT_LT(std::abs(play.state.joints[0].velocity), 1e-9);
    }
    EXPECT_NEAR(play.state.energy.joint_limit_J, kinetic_J, 2e-3 * kinetic_J);  // w T, of the chord
  }
}

// The coordinate of a hinge counts turns.
TEST(Joints, AHingeCountsItsTurns) {
  HingedRod rod;
  Playground play(weightless({rod.body(1)}, {rod.joint(1, 1)}), {rod.pose()});
  play.state.bodies[0].spin = Vec3(0, 0, -20);
  play.state.bodies[0].velocity = Vec3(-20 * 0.15, 0, 0);
  play.steps(2000);
  EXPECT_NEAR(play.state.joints[0].coordinate, -40, 0.01);
  EXPECT_NEAR(play.state.joints[0].velocity, -20, 0.01);
}

// A block of 100 g on a spring of 100 N/m along x.
Playground onSpring(double joint_friction, double floor_friction, double stretch) {
  Joint joint = jointAt(JointKind::kSlider, Vec3::Zero(), Vec3::UnitX(), Pose());
  if (floor_friction > 0) joint = distanceBetween(Vec3(0, 0.02, 0), Vec3(-0.2, 0.02, 0), placeAt(Vec3(0, 0.02, 0)));
  joint.low = floor_friction > 0 ? 0.01 : -1;
  joint.high = 1;
  joint.rest -= stretch;
  joint.spring = 100;
  joint.friction = joint_friction;
  World world = heavy({block(1, 0.1, Vec3::Constant(0.02), floor_friction)}, {named(1, 1, 0, joint)});
  if (floor_friction > 0) {
    world.fixed = floorScene(10);
    world.fixed_surface = {floor_friction, floor_friction, 0};
  } else {
    world.gravity_m_s2.setZero();
  }
  return {std::move(world), {placeAt(Vec3(0, floor_friction > 0 ? 0.02 : 0, 0))}};
}

// Turning points fall by 2 mu m g / k from side to side, and it stops within mu m g / k of the middle.
TEST(Joints, R24ABlockOnASpringWithFriction) {
  const double friction_N = 0.2 * 0.1 * kGravity, stretch = 0.0197;
  for (const bool floor : {false, true}) {
    Playground play = floor ? onSpring(0, 0.2, stretch) : onSpring(friction_N, 0, stretch);
    const double rest = play.world->joints[0].rest, begin_J = play.energy_J();
    std::vector<double> turns{stretch};
    double before = stretch;
    bool outward = false;
    for (int i = 0; i < 2000; ++i) {
      stepBooked(play, begin_J, 0.1);
      const double now = std::abs(play.state.joints[0].coordinate - rest);
      if (outward && now < before) turns.push_back(before);
      if (now != before) outward = now > before;  // where it turns it may stand for a step
      before = now;
    }
    ASSERT_GE(turns.size(), 5u) << floor;
    for (std::size_t i = 1; i < 5; ++i)
      EXPECT_NEAR(turns[i - 1] - turns[i], 2 * friction_N / 100, 0.01 * friction_N / 100) << floor << i;
    EXPECT_LE(before, friction_N / 100);
    EXPECT_LT(play.state.bodies[0].velocity.norm(), 1e-9);
    const double at_rest = play.state.joints[0].coordinate;
    play.steps(2000);
    EXPECT_NEAR(play.state.joints[0].coordinate, at_rest, 1e-12) << "it creeps";
  }
}

TEST(Joints, ASpringOfAnyStiffnessIsStable) {
  for (const double spring : {1.0, 1e3, 1e5, 1e7, 1e10, 1e14}) {
    for (const double damping : {0.0, 1.0, 1e6}) {
      Joint joint = jointAt(JointKind::kSlider, Vec3::Zero(), Vec3::UnitX(), Pose());
      joint.spring = spring;
      joint.damping = damping;
      joint.rest = -0.01;
      Playground play(heavy({block(1, 0.001, Vec3::Constant(0.01), 0)}, {named(1, 1, 0, joint)}), {Pose()});
      const double begin_J = play.energy_J();
      double most_J = 0;
      for (int i = 0; i < 1000; ++i) {
        stepBooked(play, begin_J, 1 + begin_J);
        most_J = std::max(most_J, play.energy_J());
      }
      EXPECT_LT(most_J, 1.1 * begin_J) << spring;
      EXPECT_LT(std::abs(play.state.joints[0].coordinate), 0.03) << spring;
    }
  }
}

// What a table gives is its potential: a body of any mass that snaps through never has more.
TEST(Joints, ATableGivesNoMoreThanItsPotential) {
  for (const double mass_kg : {1e-5, 1e-3, 0.1, 1.0}) {
    Joint joint = jointAt(JointKind::kSlider, Vec3::Zero(), Vec3::UnitX(), Pose());
    joint.table = {{-0.002, -0.001, 0, 0.001, 0.002}, {1, 0, 0, 0, -1}};
    joint.table.force = {0.5, -0.5, 0, 0.5, -0.5};  // two valleys with a hill at 0
    Playground play(weightless({block(1, mass_kg, Vec3::Constant(0.01), 0)}, {named(1, 1, 0, joint)}), {Pose()});
    play.state.bodies[0].velocity.x() = 1e-3;
    const double begin_J = play.energy_J();
    double highest_J = begin_J;
    for (int i = 0; i < 5000; ++i) {
      stepBooked(play, begin_J, 0.01);
      highest_J = std::max(highest_J, play.energy_J());
    }
    EXPECT_LT(highest_J - begin_J, 1e-9 * std::abs(begin_J) + 1e-12) << mass_kg;
  }
}

// A plank of 400 mm on a hinge; a block of 100 g lies 150 mm from it, the finger presses at 100 mm on the other side.
TEST(Joints, R10TheSeesawLiftsItsLoad) {
  const Vec3 plank_at(0, 0.1, 0), load_at(0.15, 0.125, 0);
  Joint hinge = named(1, 1, 0, jointAt(JointKind::kHinge, plank_at, Vec3::UnitZ(), placeAt(plank_at)));
  hinge.low = 0;
  Playground play(
      heavy({block(1, 0.2, Vec3(0.2, 0.005, 0.02), 0.5), block(2, 0.1, Vec3::Constant(0.02), 0.5)}, {hinge}),
      {placeAt(plank_at), placeAt(load_at)});
  play.steps(100);
  HandNode hand;
  hand.contacts.push({1, Vec3(-0.1, 0.105, 0), Vec3::UnitY(), 0, 0, false});
  for (const double force_N : {1.4715 - 2e-4, 1.4715 + 2e-4}) {
    hand.stretch = Vec3(0, force_N / hand.spring_N_m, 0);
    for (int i = 0; i < 300; ++i) play.step({&hand, 1});
    const bool lifts = force_N > 1.4715;
    EXPECT_EQ(play.state.joints[0].velocity > 1e-6, lifts) << play.state.joints[0].velocity;
    EXPECT_EQ(play.state.joints[0].coordinate > 1e-8, lifts);
  }
}

// An impulse in each step at r from the hinge of a door of 1 kg and 0.3 m: felt mass I / r^2.
TEST(Joints, R11TheFeltMassOfADoor) {
  for (const auto& [r, felt_kg] : {std::pair{0.3, 1.0 / 3}, std::pair{0.15, 4.0 / 3}}) {
    HingedRod door;
    door.mass_kg = 1;
    Playground play(weightless({door.body(1)}, {door.joint(1, 1)}), {door.pose()});
    for (int i = 0; i < 100; ++i) {
      HandNode hand;
      hand.spring_N_m = 1e-9;
      const Vec3 out = play.state.bodies[0].turned * -Vec3::UnitY();
      const Vec3 across = play.state.bodies[0].turned * Vec3::UnitX();
      hand.owed.push({1, r * out, 0.1 * kStep_s * across});
      play.step({&hand, 1});
    }
    EXPECT_NEAR(0.1 * 0.1 / (play.state.joints[0].velocity * r), felt_kg, 1e-5 * felt_kg);
  }
}

// The tip is pushed sideways, slowly: F = m g tan(angle) / 2.
TEST(Joints, R9ARodPushedAtItsTip) {
  HingedRod rod;
  Joint joint = rod.joint(1, 1);
  joint.damping = 0.02;  // so that it rests soon
  for (const auto& [degrees, part] : {std::pair{15.0, 0.13397}, std::pair{30.0, 0.28868}, std::pair{45.0, 0.5}}) {
    Playground play(heavy({rod.body(1)}, {joint}), {rod.pose()});
    const auto tip = [&] {
      return Vec3(play.state.bodies[0].centre + play.state.bodies[0].turned * Vec3(0, -0.15, 0));
    };
    const double weight_N = 0.1 * kGravity, angle = degrees * EIGEN_PI / 180;
    const double end = 0.3 * std::sin(angle) + weight_N * std::tan(angle) / 2 / 1000;
    Pusher finger;
    finger.finger = finger.proxy = tip();
    for (int i = 0; i < 4000; ++i) {
      finger.finger.x() = end * std::min(1.0, i / 2000.0);
      finger.finger.y() = finger.proxy.y() = tip().y();
      const HandNode node = finger.node();
      play.step({&node, 1});
      finger.tick(tip().x(), kStep_s, play.given[0]);
    }
    EXPECT_NEAR(-finger.force_N.x() / weight_N, part, 1e-5) << degrees;
    EXPECT_NEAR(play.state.joints[0].coordinate, angle, 1e-5);
  }
}

TEST(Joints, AStepTakesNoMemory) {
  HingedRod rod;
  Joint joint = rod.joint(1, 1);
  joint.spring = 1;
  joint.table = {{-1, 0, 1}, {0.1, 0, -0.2}};
  joint.low = -1;
  joint.high = 1;
  Playground play(heavy({rod.body(1), ball(2, 0.1, 0.01, 0)},
                        {joint, named(2, 2, 1,
                                      jointAt(JointKind::kBall, Vec3(0, -0.3, 0), Vec3::UnitX(),
                                              placeAt(Vec3(0, -0.32, 0)), rod.pose()))}),
                  {rod.pose(), placeAt(Vec3(0, -0.32, 0))});
  play.state.bodies[1].velocity.x() = 1;
  const RealtimeGuard guard;
  play.steps(1000);
}

}  // namespace
}  // namespace hl::test_joints
