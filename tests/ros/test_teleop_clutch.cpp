// Where a hand wants a robot to be: by its way, at a scale, while the clutch holds.
#include "ros/teleop_clutch.h"

#include <gtest/gtest.h>

#include <limits>

namespace hl::test_teleop_clutch {
namespace {

TeleopSettings scaled(double scale, std::optional<std::uint32_t> button) {
  TeleopSettings settings;
  settings.scale = scale;
  settings.clutch_button = button;
  return settings;
}

TEST(TeleopClutch, WithoutAButtonTheRobotFollowsAtOnceFromWhereItIs) {
  TeleopClutch clutch(scaled(2, std::nullopt));
  clutch.follow(Vec3(1, 1, 1), 0, true);
  EXPECT_TRUE(clutch.engaged());
  EXPECT_EQ(clutch.setPoint(), Vec3(0, 0, 0));
  clutch.follow(Vec3(1.5, 1, 0), 0, true);
  EXPECT_EQ(clutch.setPoint(), Vec3(1, 0, -2));
}

TEST(TeleopClutch, WithAButtonItWaitsForOneWholePress) {
  TeleopClutch clutch(scaled(1, 3));
  clutch.follow(Vec3(0, 0, 0), 0, true);
  EXPECT_FALSE(clutch.engaged());
  clutch.follow(Vec3(0, 0, 0), 1U << 3, true);
  EXPECT_FALSE(clutch.engaged());
  clutch.follow(Vec3(0, 0, 0), 1U << 2, true);
  EXPECT_TRUE(clutch.engaged());
}

TEST(TeleopClutch, OpenItKeepsTheSetPointAndTakesTheWayUpAgainWithoutAJump) {
  TeleopClutch clutch(scaled(1, std::nullopt));
  clutch.follow(Vec3(0, 0, 0), 0, true);
  clutch.follow(Vec3(0.1, 0, 0), 0, true);
  clutch.follow(Vec3(0.5, 0, 0), 0, false);  // the servo makes no force
  EXPECT_FALSE(clutch.engaged());
  EXPECT_EQ(clutch.setPoint(), Vec3(0.1, 0, 0));
  clutch.follow(Vec3(-0.3, 0, 0), 0, true);
  EXPECT_NEAR(clutch.setPoint().x(), 0.1, 1e-12);
  clutch.follow(Vec3(-0.2, 0, 0), 0, true);
  EXPECT_NEAR(clutch.setPoint().x(), 0.2, 1e-12);
}

TEST(TeleopClutch, APlaceThatIsNoNumberLeadsNobody) {
  TeleopClutch clutch(scaled(1, std::nullopt));
  clutch.follow(Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0), 0, true);
  EXPECT_FALSE(clutch.engaged());
  EXPECT_TRUE(clutch.setPoint().allFinite());
}

}  // namespace
}  // namespace hl::test_teleop_clutch
