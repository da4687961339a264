// Sleep: what is still costs nothing, and wakes when it must; and the same bits, whatever came first.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bodies/mesh_body.h"
#include "bodies/motion_plan.h"
#include "bodies/sleep.h"
#include "bodies/world_hash.h"
#include "mesh_drawings.h"

namespace hl::test_sleep {
namespace {

using namespace test;

void addStack(World& world, std::vector<Pose>& poses, double x, int cubes) {
  for (int i = 0; i < cubes; ++i) {
    world.bodies.push_back(block(world.bodies.size() + 1, 0.1, Vec3::Constant(0.02), 0.5));
    poses.push_back(placeAt(Vec3(x, 0.02 + 0.04 * i, 0)));
  }
}

// Two stacks, of bodies 1 to 5 and 6 to 10.
std::unique_ptr<Playground> twoStacks(double seconds) {
  World world;
  world.fixed = floorScene();
  std::vector<Pose> poses;
  addStack(world, poses, 0, 5);
  addStack(world, poses, 0.3, 5);
  auto play = std::make_unique<Playground>(std::move(world), poses);
  play->steps(static_cast<int>(seconds / kStep_s));
  return play;
}

bool sleeps(const Playground& play, std::size_t first, std::size_t end) {
  return std::all_of(play.state.bodies.begin() + static_cast<std::ptrdiff_t>(first),
                     play.state.bodies.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const BodyState& body) { return body.island != 0; });
}

bool samePlaces(const WorldState& x, const WorldState& y, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    if (x.bodies[i].centre != y.bodies[i].centre || x.bodies[i].turned.coeffs() != y.bodies[i].turned.coeffs())
      return false;
  }
  return true;
}

TEST(Sleep, AStackFallsAsleepAndMovesNoBitAfterwards) {
  const auto stacks = twoStacks(0.4);
  Playground& play = *stacks;
  EXPECT_FALSE(sleeps(play, 0, 10));
  play.steps(300);
  EXPECT_TRUE(sleeps(play, 0, 10));
  EXPECT_EQ(play.state.bodies[4].island, 1u);
  EXPECT_EQ(play.state.bodies[5].island, 6u);
  const WorldState then = play.state;
  for (int i = 0; i < 1000; ++i) {
    const BodyStepReport report = play.step();
    EXPECT_EQ(report.rows, 0);
    EXPECT_EQ(report.awake, 0);
  }
  EXPECT_TRUE(samePlaces(then, play.state, 0, 10));
  EXPECT_EQ(play.state.energy.contact_J, then.energy.contact_J);
}

TEST(Sleep, TheEnergyOfWhatFallsAsleepIsBooked) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {ball(1, 0.2, 0.01, 0)};
  Playground play(std::move(world), {placeAt(Vec3::Zero())});
  play.state.bodies[0].velocity = Vec3(0.0009, 0, 0);
  const double begin_J = play.energy_J();
  play.steps(600);
  EXPECT_EQ(play.state.bodies[0].velocity, Vec3::Zero());
  EXPECT_NEAR(play.state.energy.contact_J, begin_J, 1e-18);
}

double deepestOf(Playground& play) {
  wakeAll(play.state);
  return play.step().deepest;
}

// A box in the floor, and one in the other. No step moves anything faster than the two overlaps are removed.
TEST(Sleep, WhatBeginsOverlappedComesApartBeforeItSleeps) {
  for (const double gravity : {0.0, -9.81}) {
    for (const double overlap_m : {2e-5, 5e-4, 2e-3, 5e-3}) {
      World world;
      world.gravity_m_s2 = Vec3(0, gravity, 0);
      world.fixed = floorScene();
      world.bodies = {block(1, 0.1, Vec3::Constant(0.02), 0.5), block(2, 0.1, Vec3::Constant(0.02), 0.5)};
      Playground play(std::move(world),
                      {placeAt(Vec3(0, 0.02 - overlap_m, 0)), placeAt(Vec3(0, 0.06 - 2 * overlap_m, 0.003))});
      const double begin_J = play.energy_J();
      double fastest_m_s = 0;
      for (int i = 0; i < 800; ++i) {
        const double last_m = play.state.bodies[1].centre.y();
        play.step();
        fastest_m_s = std::max(fastest_m_s, (play.state.bodies[1].centre.y() - last_m) / kStep_s);
        ASSERT_NEAR(play.energy_J() - begin_J, play.state.energy.change_J(), 1e-12) << i;
      }
      EXPECT_TRUE(sleeps(play, 0, 2)) << gravity << " " << overlap_m;
      EXPECT_LT(fastest_m_s, 2.1 * kMaxApart_m_s);
      EXPECT_LT(deepestOf(play), 2e-9) << gravity << " " << overlap_m;
    }
  }
}

TEST(Sleep, WhatIsWedgedSleepsLater) {
  World world;
  world.gravity_m_s2.setZero();
  world.fixed = makeSnapshot(boxModel(Vec3(0.019, 0.1, 0.1)));
  world.bodies = {block(1, 0.1, Vec3::Constant(0.02), 0.5)};
  Playground play(std::move(world), {placeAt(Vec3::Zero())});
  play.steps(4900);
  EXPECT_FALSE(sleeps(play, 0, 1));
  play.steps(200);
  EXPECT_TRUE(sleeps(play, 0, 1));
  EXPECT_LT(play.state.bodies[0].centre.norm(), 1e-3);
}

TEST(Sleep, AHitWakesJustItsIsland) {
  const auto stacks = twoStacks(1);
  Playground& quiet = *stacks;
  World world = *quiet.world;
  world.bodies.push_back(ball(11, 0.1, 0.02, 0.5));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < 10; ++i) poses.push_back(poseOf(world.bodies[i], quiet.state.bodies[i]));
  poses.push_back(placeAt(Vec3(-0.1, 0.1, 0)));
  Playground play(std::move(world), poses);
  for (std::size_t i = 0; i < 10; ++i) play.state.bodies[i] = quiet.state.bodies[i];
  play.state.asleep = quiet.state.asleep;
  play.state.bodies[10].velocity = Vec3(1, 0, 0);
  Playground awake(*play.world, poses);
  awake.state = play.state;
  wakeAll(awake.state);
  const WorldState then = play.state;
  int woke = -1;
  for (int i = 0; i < 100 && woke < 0; ++i) {
    play.step();
    awake.step();
    if (!sleeps(play, 0, 5)) woke = i;
  }
  ASSERT_GT(woke, 50);  // 60 mm of gap at 1 m/s
  EXPECT_TRUE(sleeps(play, 5, 10));
  // The very step of the impact gives what it gives to a stack that is awake.
  for (std::size_t i = 0; i < 11; ++i)
    EXPECT_LT((play.state.bodies[i].velocity - awake.state.bodies[i].velocity).norm(), 5e-5) << i;
  play.steps(50);
  EXPECT_TRUE(samePlaces(then, play.state, 5, 10));
  EXPECT_GT(play.state.bodies[2].centre.x(), then.bodies[2].centre.x() + 1e-4);
}

TEST(Sleep, AHandWakesWhatItTouchesAndKeepsItAwake) {
  const auto stacks = twoStacks(1);
  Playground& play = *stacks;
  HandNode hand;
  hand.stretch = Vec3(0, 0.001, 0);
  hand.contacts.push({5, Vec3(0, 0.2, 0), Vec3::UnitY(), 0, 0, false});
  for (int i = 0; i < 1500; ++i) {
    play.step({&hand, 1});
    ASSERT_FALSE(sleeps(play, 0, 5));
  }
  EXPECT_TRUE(sleeps(play, 5, 10));
  double pressed = 0;
  for (const Row& row : play.stepper.rows()) pressed += row.pair.a == 1 && row.pair.b == 0 ? row.pressed : 0;
  EXPECT_NEAR(pressed / kStep_s, 1 + 0.5 * kGravity, 1e-6);
  play.steps(700);
  EXPECT_TRUE(sleeps(play, 0, 5));
}

TEST(Sleep, WhatHeldItIsTakenAwayOrGravityChanges) {
  const auto stacks = twoStacks(1);
  Playground& play = *stacks;
  World left = *play.world;
  left.bodies.erase(left.bodies.begin() + 2);  // body 3
  Playground without(left, std::vector<Pose>(9));
  without.state = play.state;
  wake(*play.world, without.state, 3);
  without.state.bodies.erase(without.state.bodies.begin() + 2);
  EXPECT_FALSE(sleeps(without, 0, 4));
  EXPECT_TRUE(sleeps(without, 4, 9));
  without.steps(1500);
  EXPECT_NEAR(without.state.bodies[2].centre.y(), 0.1, 1e-4);  // body 4 fell by 40 mm
  EXPECT_TRUE(sleeps(without, 0, 9));
  left.gravity_m_s2 = Vec3(0, 9.81, 0);
  Playground up(left, std::vector<Pose>(9));
  up.state = without.state;
  up.steps(100);
  for (const BodyState& body : up.state.bodies) EXPECT_GT(body.velocity.y(), 0.9);
}

// Bodies in the order in which they were made, with keys of their own.
struct Crowd {
  explicit Crowd(std::size_t count, std::uint64_t order) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::uint64_t key = 1; key <= count; ++key) {
      const double x = 0.1 * static_cast<double>(key % 10), z = 0.1 * static_cast<double>(key / 10 % 10);
      const Vec3 at(x - 0.45, 0.1 + 0.1 * static_cast<double>(key / 100), z - 0.45);
      const double size = 0.02 + 0.01 * uniform(random);
      made.emplace_back(bodyOfSize(key, size), placeAt(at + 0.01 * Vec3(uniform(random), 0, uniform(random))));
    }
    std::mt19937_64 shuffle(order);
    if (order > 0) std::shuffle(made.begin(), made.end(), shuffle);
    std::sort(made.begin(), made.end(), [](const auto& x, const auto& y) { return x.first.key < y.first.key; });
  }
  static Body bodyOfSize(std::uint64_t key, double size) {
    if (key % 2 == 0) return ball(key, 0.1, size, 0.4, 0.3);
    if (key % 5 > 0) return block(key, 0.1, Vec3::Constant(size), 0.4);
    BodySpec spec;
    spec.shape = BodyShape::kParts;
    Body cup = bodyOf(cupModel(size, 2 * size, size / 4), spec);
    cup.key = key;
    return cup;
  }
  std::unique_ptr<Playground> play() const {
    World world;
    world.fixed = floorScene();
    std::vector<Pose> poses;
    for (const auto& [body, pose] : made) {
      world.bodies.push_back(body);
      poses.push_back(pose);
    }
    return std::make_unique<Playground>(std::move(world), poses);
  }
  std::vector<std::pair<Body, Pose>> made;
};

// R28: the state goes to another stepper at a random step, as from a file.
TEST(Sleep, R28TheSameBitsWhateverTheOrderAndWhereverItIsTakenUp) {
  const auto one = Crowd(300, 0).play(), other = Crowd(300, 7).play();
  std::mt19937_64 random(3);
  auto taken_up = Crowd(300, 8).play();
  for (int step = 0; step < 400; ++step) {
    one->step();
    other->step();
    taken_up->step();
    if (random() % 50 == 0) {
      const WorldState saved = taken_up->state;
      taken_up = Crowd(300, 9).play();
      taken_up->state = saved;
    }
    ASSERT_EQ(hashOf(*one->world, one->state), hashOf(*other->world, other->state)) << step;
    ASSERT_EQ(hashOf(*one->world, one->state), hashOf(*taken_up->world, taken_up->state)) << step;
  }
  WorldState changed = one->state;
  changed.bodies[299].spin.z() += 1e-12;
  EXPECT_NE(hashOf(*one->world, one->state), hashOf(*one->world, changed));
}

}  // namespace
}  // namespace hl::test_sleep
