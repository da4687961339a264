// The direction of a vector of any length.
#include "base/direction.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace hl::test_direction {
namespace {

TEST(UnitOf, IsTheDirectionOfAnyFiniteVectorButZero) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> coordinate;
  std::uniform_int_distribution<int> exponent(-1010, 1010);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 v(coordinate(random), coordinate(random), coordinate(random));
    const int e = exponent(random);
    const auto unit = unitOf({std::scalbn(v.x(), e), std::scalbn(v.y(), e), std::scalbn(v.z(), e)});
    ASSERT_TRUE(unit);
    EXPECT_LT((*unit - v.normalized()).norm(), 1e-15) << v.transpose() << " * 2^" << e;
    EXPECT_EQ(*unitOf(v), v.normalized()) << "to the bit, where nothing leaves the range";
  }
  const double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  EXPECT_LT((*unitOf({largest, -largest, largest}) - Vec3(1, -1, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((*unitOf({0, least, least}) - Vec3(0, 1, 1).normalized()).norm(), 1e-15);
  EXPECT_EQ(*unitOf({largest, least, 0}), Vec3::UnitX());
}

TEST(UnitOf, IsNothingWhereThereIsNoDirection) {
  EXPECT_FALSE(unitOf({0, -0.0, 0}));
  EXPECT_FALSE(unitOf({1, std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(unitOf({std::numeric_limits<double>::infinity(), 0, 0}));
}

}  // namespace
}  // namespace hl::test_direction
