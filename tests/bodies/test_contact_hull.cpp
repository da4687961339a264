// Which contacts others keep apart.
#include "bodies/contact_hull.h"

#include <gtest/gtest.h>

#include <vector>

namespace hl::test_contact_hull {
namespace {

constexpr double kSlack_m = 1e-9;

std::vector<FlatContact> square(double gap_of_right = 0) {
  return {{{-1, -1}, 0}, {{-1, 1}, 0}, {{1, -1}, gap_of_right}, {{1, 1}, gap_of_right}};
}

TEST(ContactHull, KeepsWhatLiesWithinItsCorners) {
  const ContactHull hull(square());
  for (const double x : {-0.8, 0.0, 0.3}) {
    for (const double y : {-0.8, 0.0, 0.8}) EXPECT_TRUE(hull.keeps({{x, y}, 0}, kSlack_m)) << x << ' ' << y;
  }
}

TEST(ContactHull, KeepsNoCornerAndNothingOnItsSidesOrBeyond) {
  const ContactHull hull(square());
  for (const FlatContact& corner : square()) EXPECT_FALSE(hull.keeps(corner, kSlack_m));
  EXPECT_FALSE(hull.keeps({{1, 0.3}, 0}, kSlack_m));
  EXPECT_FALSE(hull.keeps({{0, -1}, 0}, kSlack_m));
  EXPECT_FALSE(hull.keeps({{1.5, 0}, 0}, kSlack_m));
}

TEST(ContactHull, KeepsNothingThatIsNearerThanItsPlane) {
  const ContactHull hull(square(1e-6));
  EXPECT_TRUE(hull.keeps({{0.5, 0}, 0.75e-6}, kSlack_m));
  EXPECT_FALSE(hull.keeps({{0.5, 0}, 0.74e-6}, kSlack_m));
  EXPECT_FALSE(ContactHull(square()).keeps({{0, 0}, -1e-8}, kSlack_m));
}

TEST(ContactHull, OfOneOrTwoContactsKeepsNothing) {
  EXPECT_FALSE(ContactHull(std::vector<FlatContact>{}).keeps({{0, 0}, 0}, kSlack_m));
  EXPECT_FALSE(ContactHull(std::vector<FlatContact>{{{0, 0}, 0}}).keeps({{0, 0}, 0}, kSlack_m));
  EXPECT_FALSE(ContactHull(std::vector<FlatContact>{{{-1, 0}, 0}, {{1, 0}, 0}}).keeps({{0, 0}, 0}, kSlack_m));
}

}  // namespace
}  // namespace hl::test_contact_hull
