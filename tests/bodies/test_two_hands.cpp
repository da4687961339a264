// R19: two fingers lift a block between them: both are nodes of the solve that moves it.
#include <gtest/gtest.h>

#include "bodies/test_worlds.h"

namespace hl::test_two_hands {
namespace {

constexpr double kMass_kg = 0.1, kHalf_m = 0.02, kFriction = 0.5, kStiffness_N_m = 1000;
// What two contacts need to hold the weight: m g / (2 mu).
constexpr double kHolds_N = kMass_kg * test::kGravity / (2 * kFriction);

// A finger that presses on the block's face, its proxy held by friction.
struct Finger {
  Vec3 normal;  // of the face
  Vec3 finger, proxy;

  HandNode node() const {
    HandNode hand;
    hand.proxy = proxy;
    hand.stretch = proxy - finger;
    hand.spring_N_m = kStiffness_N_m;
    hand.contacts.push({1, proxy, normal, kFriction, kFriction, false});
    return hand;
  }
  // After a step: the force on the hand is what the block got, the other way.
  void follow(const GivenImpulses& given) {
    Vec3 force_N = Vec3::Zero();
    for (const BodyImpulse& one : given) force_N -= one.impulse_N_s / test::kStep_s;
    proxy = finger + force_N / kStiffness_N_m;
  }
};

// The block in the air between two fingers that press so much, and hold its weight.
class Grip {
 public:
  explicit Grip(double squeeze_N) : ground_(worldOfBlock(), {test::placeAt(Vec3::Zero())}) {
    const double sag_m = kMass_kg * test::kGravity / (2 * kStiffness_N_m);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 normal(side, 0, 0), proxy = kHalf_m * normal;
      fingers_.push_back({normal, proxy - squeeze_N / kStiffness_N_m * normal + Vec3(0, sag_m, 0), proxy});
    }
  }

  void lift(double acceleration_m_s2, double seconds) {
    for (double t = 0; t < seconds; t += test::kStep_s) {
      speed_m_s_ += test::kStep_s * acceleration_m_s2;
      std::vector<HandNode> hands;
      for (Finger& finger : fingers_) {
        finger.finger.y() += test::kStep_s * speed_m_s_;
        hands.push_back(finger.node());
      }
      ground_.step(hands);
      for (std::size_t i = 0; i < fingers_.size(); ++i) fingers_[i].follow(ground_.given[i]);
    }
  }
  double height_m() const { return ground_.state.bodies[0].centre.y(); }
  double lifted_m() const { return fingers_[0].proxy.y(); }
  double turned() const { return ground_.state.bodies[0].turned.vec().norm(); }

 private:
  static World worldOfBlock() {
    World world;
    world.bodies.push_back(test::block(1, kMass_kg, Vec3::Constant(kHalf_m), kFriction));
    return world;
  }

  test::Playground ground_;
  std::vector<Finger> fingers_;
  double speed_m_s_ = 0;
};

TEST(TwoHands, R19HoldWithASqueezeOfTheWeightOverTwiceTheFriction) {
  static_assert(kHolds_N > 0.98099 && kHolds_N < 0.98101);
  Grip grip(1.001 * kHolds_N);
  grip.lift(0, 2);
  EXPECT_NEAR(grip.height_m(), 0, 1e-9);
  grip.lift(1e-3, 2);
  EXPECT_GT(grip.lifted_m(), 0.0019);
  EXPECT_NEAR(grip.height_m(), grip.lifted_m(), 1e-6);
  EXPECT_LT(grip.turned(), 1e-9);
}

// With a thousandth less the block falls with a thousandth of g.
TEST(TwoHands, R19LetItSlideWithLess) {
  Grip grip(0.999 * kHolds_N);
  grip.lift(0, 1);
  EXPECT_NEAR(grip.height_m(), -0.001 * test::kGravity / 2, 0.02 * 0.001 * test::kGravity / 2);
}

}  // namespace
}  // namespace hl::test_two_hands
