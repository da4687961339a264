// The functions of plain_math.h against those of the C library in long double.
#include "base/plain_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hl::test_plain_math {
namespace {

// How far `found` is from the exact value, in units of its last place; near zero, of the last place of `least`.
double unitsOff(double found, long double exact, double least = 0) {
  const double size = std::max(std::abs(static_cast<double>(exact)), least);
  const double unit = std::nextafter(size, HUGE_VAL) - size;
  return static_cast<double>(std::abs(static_cast<long double>(found) - exact)) / unit;
}

TEST(PlainMath, SineAndCosineAreWithinThreeUnits) {
  std::mt19937_64 random(1);
  for (const double range : {1e-3, 1.0, 10.0, 1e3, 1e6}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 20'000; ++i) {
      const double x = uniform(random);
      EXPECT_LE(unitsOff(plain::sin(x), sinl(x)), 3) << x;
      EXPECT_LE(unitsOff(plain::cos(x), cosl(x)), 3) << x;
    }
  }
}

TEST(PlainMath, SineAndCosineOfWholeQuartersAreThoseOfTheRoundedAngle) {
  for (int k = -1000; k <= 1000; ++k) {
    const double x = k * M_PI_2;
    EXPECT_LE(unitsOff(plain::sin(x), sinl(x), 1e-16), 2) << k;
    EXPECT_LE(unitsOff(plain::cos(x), cosl(x), 1e-16), 2) << k;
  }
  EXPECT_EQ(plain::sin(0), 0);
  EXPECT_EQ(plain::cos(0), 1);
}

TEST(PlainMath, SineAndCosineOfWhatHasNoQuarterAreNotANumber) {
  for (const double x : {HUGE_VAL, -HUGE_VAL, 1e10, -1e300, std::nan("")}) {
    EXPECT_TRUE(std::isnan(plain::sin(x))) << x;
    EXPECT_TRUE(std::isnan(plain::cos(x))) << x;
  }
  EXPECT_LE(std::abs(plain::sin(1e9)), 1);
}

TEST(PlainMath, TheAngleIsWithinFiveUnits) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::exp(exponent(random)), y = std::exp(exponent(random));
    EXPECT_LE(unitsOff(plain::angleOf(x, y), atan2l(y, x)), 5) << x << " " << y;
  }
  EXPECT_EQ(plain::angleOf(1, 0), 0);
  EXPECT_EQ(plain::angleOf(0, 1), M_PI_2);
}

TEST(PlainMath, ThePowerOfEIsWithinTwoUnits) {
  std::mt19937_64 random(3);
  for (const double range : {1e-6, 1.0, 30.0, 700.0}) {
    std::uniform_real_distribution<double> uniform(-range, 0);
    for (int i = 0; i < 20'000; ++i) {
      const double x = uniform(random);
      EXPECT_LE(unitsOff(plain::expOfNegative(x), expl(x)), 2) << x;
    }
  }
  EXPECT_EQ(plain::expOfNegative(0), 1);
  EXPECT_EQ(plain::expOfNegative(-1e300), 0);
  EXPECT_EQ(plain::expOfNegative(-HUGE_VAL), 0);
}

TEST(PlainMath, TheCubeRootIsWithinTwoUnits) {
  for (const double n : {1.0, 2.0, 8.0, 27.0, 1000.0, 20'000.0, 5e7, 1e15})
    EXPECT_LE(unitsOff(plain::cubeRoot(n), cbrtl(n)), 2) << n;
}

}  // namespace
}  // namespace hl::test_plain_math
