// What the proxy has just left, and the planes that go on to count.
#include "proxy/recent_cuts.h"

#include <gtest/gtest.h>

#include "proxy/judge.h"
#include "proxy/tolerances.h"

namespace hl::test_recent_cuts {
namespace {

constexpr double kRadius = 1e-3;

// Two wires along y, 2 mm apart.
std::shared_ptr<const Snapshot> wires() {
  Model model;
  model.positions = {Vec3(-1e-3, -1, 0), Vec3(-1e-3, 1, 0), Vec3(1e-3, -1, 0), Vec3(1e-3, 1, 0)};
  model.segments = {{0, 1}, {2, 3}};
  return judge::scene(model);
}

class Left : public ::testing::Test {
 protected:
  ContactSet contactsAt(const Vec3& centre) const {
    ContactSet set;
    gatherContacts(scene_, centre, tolerance_.touching, tolerance_.reach, set);
    return set;
  }
  std::size_t planesAt(const Vec3& centre) {
    planes_.clear();
    return left_.addPlanes(scene_, centre, tolerance_.reach, planes_);
  }
  // Touches the first wire from above and is held by it.
  void touchFirst() {
    const ContactSet set = contactsAt(kAboveFirst);
    ASSERT_EQ(set.contacts.size(), 1u);
    left_.update(set);
    left_.addActive(set.contacts[0].primitive);
  }

  const Vec3 kAboveFirst{-1e-3, 0, kRadius};
  std::shared_ptr<const Snapshot> snapshot_ = wires();
  SceneAt scene_{*snapshot_};
  Tolerances tolerance_ = Tolerances::of(kRadius, scene_.extent());
  RecentCuts left_;
  RecentCuts::Planes planes_;
};

TEST_F(Left, WhatIsStillTouchedIsNotLeft) {
  touchFirst();
  left_.update(contactsAt(kAboveFirst));
  EXPECT_TRUE(left_.empty());
}

TEST_F(Left, ItsPlaneIsThatOfWhereTheProxyIsNow) {
  touchFirst();
  const Vec3 away(-1e-3 + 1e-5, 0, kRadius);  // a step along the tangent
  left_.update(contactsAt(away));
  ASSERT_EQ(planesAt(away), 1u);
  const Vec3 normal = Vec3(1e-5, 0, kRadius).normalized();
  EXPECT_LT((planes_[0].normal - normal).norm(), 1e-12);
  EXPECT_NEAR(planes_[0].offset, tolerance_.reach - std::hypot(1e-5, kRadius), 1e-15);
}

TEST_F(Left, ItCountsForOneStepUnlessThatIsHeldByItStill) {
  const Vec3 away(-1e-3 + 1e-5, 0, kRadius);
  touchFirst();
  left_.update(contactsAt(away));
  EXPECT_FALSE(left_.empty());
  left_.keepActive();
  left_.update(contactsAt(away));
  EXPECT_FALSE(left_.empty());
  left_.update(contactsAt(away));
  EXPECT_TRUE(left_.empty());
}

TEST_F(Left, WhatIsFarNoLongerCounts) {
  touchFirst();
  const Vec3 away(-1e-3, 0, 1.1 * kRadius);
  left_.update(contactsAt(away));
  EXPECT_FALSE(left_.empty());
  EXPECT_EQ(planesAt(away), 0u);
}

}  // namespace
}  // namespace hl::test_recent_cuts
