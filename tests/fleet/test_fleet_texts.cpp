#include "fleet/fleet_texts.h"

#include <gtest/gtest.h>

namespace hl::test_fleet_texts {
namespace {

TEST(FleetTexts, ReportCountRateAndTimeLeft) {
  EXPECT_EQ(fleetProgressText(0, 1000, 3), "0 of 1000 tasks");
  EXPECT_EQ(fleetProgressText(5, 1000, 0), "5 of 1000 tasks");
  EXPECT_EQ(fleetProgressText(800, 1000, 2), "800 of 1000 tasks, 400 a second, 0 s left");
  EXPECT_EQ(fleetProgressText(1, 11, 2), "1 of 11 tasks, 0.5 a second, 20 s left");
  EXPECT_EQ(fleetProgressText(100'000, 1'000'000, 100), "100000 of 1000000 tasks, 1000 a second, 15 min left");
  EXPECT_EQ(fleetProgressText(10, 1010, 100), "10 of 1010 tasks, 0.1 a second, 2.8 h left");
}

TEST(FleetTexts, AreOneLineOfUtf8) {
  EXPECT_EQ(oneLineOf("a\nb\tc"), "a b c");
  EXPECT_EQ(oneLineOf("\xC3\xBC\xFF"), "\xC3\xBC?");
  EXPECT_EQ(oneLineOf(std::string(3000, 'x')), std::string(500, 'x'));
}

}  // namespace
}  // namespace hl::test_fleet_texts
