// AndersonMixing, on maps whose fixed point is known.
#include "proxy/anderson_mixing.h"

#include <gtest/gtest.h>

#include <random>

namespace hl::test_anderson_mixing {
namespace {

// Passes x -> centre + shrink (x - centre) in the plane z = 0 until one changes nothing; returns how many.
int passesUntilStill(const Mat3& shrink, const Vec3& centre, Vec3 x) {
  AndersonMixing mixing;
  for (int pass = 1; pass < 100; ++pass) {
    const Vec3 next = centre + shrink * (x - centre);
    if ((next - x).norm() <= 1e-9) {
      EXPECT_LE((next - centre).norm(), 1e-9);
      return pass;
    }
    x = mixing.guess(next, next - x);
  }
  return 100;
}

// Two differences give all of a linear map of the plane: the third guess is the fixed point, and the fourth pass finds
// it still; with almost parallel differences the fifth. Without mixing these take 12 on average.
TEST(AndersonMixing, FindsTheFixedPointOfALinearMapOfThePlaneInFourPassesOrFive) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-0.2, 0.2);
  for (int i = 0; i < 1000; ++i) {
    Mat3 shrink = Mat3::Zero();
    shrink.topLeftCorner<2, 2>() << u(random), u(random), u(random), u(random);
    EXPECT_LE(passesUntilStill(shrink, {u(random), u(random), 0}, {u(random), u(random), 0}), 5);
  }
}

TEST(AndersonMixing, TakesThePassItselfWhereThePassesDoNotShrink) {
  AndersonMixing mixing;
  EXPECT_EQ(mixing.guess({1, 0, 0}, {1, 0, 0}), Vec3(1, 0, 0));
  EXPECT_EQ(mixing.guess({2, 0, 0}, {1, 0, 0}), Vec3(2, 0, 0));        // the same change again: no difference
  EXPECT_EQ(mixing.guess({3.9, 0, 0}, {1.9, 0, 0}), Vec3(3.9, 0, 0));  // a larger one
}

}  // namespace
}  // namespace hl::test_anderson_mixing
