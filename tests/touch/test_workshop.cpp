// The workshop, whose things stand, hang and lie still until they are touched.
#include <gtest/gtest.h>

#include <cmath>

#include "touch/body_world.h"
#include "workshop.h"

namespace hl::test_workshop {
namespace {

class Shop {
 public:
  // The energy book closes in each step.
  void run(double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / 1e-3));
    for (int i = 0; i < steps; ++i) {
      const double before_J = energy_J(), booked_J = world_->state().energy.change_J();
      world_->step(time_ns_ += 1'000'000, 1e-3, {});
      const double booked = world_->state().energy.change_J() - booked_J;
      ASSERT_NEAR(energy_J() - before_J, booked, 1e-9 * (std::abs(before_J) + std::abs(booked))) << i;
    }
  }
  double energy_J() const {
    return kineticEnergy_J(world_->world(), world_->state()) + gravityEnergy_J(world_->world(), world_->state()) +
           springEnergy_J(world_->world(), world_->state());
  }
  std::size_t number(const std::string& name) const {
    for (std::size_t i = 0; i < world_->world().bodies.size(); ++i) {
      if (world_->body(i).name == name) return i;
    }
    ADD_FAILURE() << "there is no " << name;
    return 0;
  }
  const BodyState& body(const std::string& name) const { return world_->state().bodies[number(name)]; }
  // How upright a body is: the cosine of the angle between its y axis and the world's.
  double upright(const std::string& name) const { return (body(name).turned * Vec3::UnitY()).y(); }
  BodyWorld& bodies() { return *world_; }

 private:
  std::unique_ptr<BodyWorld> world_ = BodyWorld::of(*makeSnapshot(makeWorkshop()));
  std::int64_t time_ns_ = 0;
};

TEST(Workshop, StaysAsItIsUntilItIsTouched) {
  Shop shop;
  shop.run(5);
  EXPECT_EQ(shop.bodies().view().returned, 0U);
  for (std::size_t i = 0; i < shop.bodies().world().bodies.size(); ++i) {
    const BodyState& body = shop.bodies().state().bodies[i];
    if (shop.bodies().body(i).name == "top") continue;
    EXPECT_LT(body.velocity.norm(), 1e-3) << shop.bodies().body(i).name;
    const double reach = shop.bodies().world().bodies[i].shape.reach;
    EXPECT_LT(body.spin.norm() * reach, 1e-3) << shop.bodies().body(i).name;
  }
  for (int i = 1; i <= 9; ++i) EXPECT_GT(shop.upright("domino " + std::to_string(i)), 0.999) << i;
  const Vec3 from_bowl = shop.body("ball").centre - Vec3(0.03, 0, 0.075);
  EXPECT_LT(std::hypot(from_bowl.x(), from_bowl.z()), 0.015);
  EXPECT_GT(from_bowl.y(), 0.006);
  EXPECT_GT(shop.upright("top"), 0.9) << "it spins";
}

TEST(Workshop, OneDominoTipsAllOfThem) {
  Shop shop;
  shop.run(1);
  shop.bodies().set(shop.number("domino 1"), Vec3(0.15, 0, 0), Vec3(0, 0, -10));
  shop.run(2);
  for (int i = 1; i <= 9; ++i) EXPECT_LT(shop.upright("domino " + std::to_string(i)), 0.7) << i;
  EXPECT_EQ(shop.bodies().view().returned, 0U);
}

// A push along the table: the peg stops the ring, which has 5 mm of way.
TEST(Workshop, TheRingDoesNotLeaveItsPeg) {
  Shop shop;
  shop.run(1);
  for (const Vec3& way : {Vec3(0.3, 0, 0), Vec3(-0.3, 0, 0.3), Vec3(0, 0, -0.5)}) {
    shop.bodies().set(shop.number("ring"), way, Vec3::Zero());
    shop.run(1);
    const Vec3 from_peg = shop.body("ring").centre - Vec3(0.035, 0, -0.03);
    EXPECT_LT(std::hypot(from_peg.x(), from_peg.z()), 0.00501) << way.transpose();
  }
  EXPECT_EQ(shop.bodies().world().bodies[shop.number("ring")].shape.parts.size(), 16U);
}

}  // namespace
}  // namespace hl::test_workshop
