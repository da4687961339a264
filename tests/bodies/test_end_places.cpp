// Where bodies end is kept from look to look: it is always that of the way, the turn, the part and the period asked
// for.
#include <gtest/gtest.h>

#include <memory>

#include "bodies/body_problem.h"
#include "test_worlds.h"

namespace hl::test_end_places {
namespace {

TEST(EndPlaces, AreThoseOfEachWayTurnPartAndPeriod) {
  World world;
  world.bodies.push_back(test::block(1, 0.1, Vec3(0.01, 0.02, 0.03), 0.4));
  BodyProblem problem(std::make_shared<const World>(world));
  const WorldState state = startWorld(*problem.world, {Pose()});
  EndPlaces kept(*problem.world);
  for (const double part : {1.0, 0.25}) {
    for (const Vec3& way : {Vec3(Vec3::Zero()), Vec3(1e-3, 0, 2e-3)}) {
      for (const Vec3& turn : {Vec3(Vec3::Zero()), Vec3(30, -40, 50)}) {
        for (const double period_s : {1e-3, 2e-3}) {
          problem.period_s = period_s;
          const BodyWays plan{{way}, {turn}, {part}};
          PlacedRoom room;
          const PlacedConvex judge =
              placed(problem.world->bodies[0].shape.parts[0], problem.stateAtEnd(state, 0, plan), room);
          const PlacedConvex found = kept.of(problem, state, 0, plan)[0];
          ASSERT_EQ(found.vertices.size(), judge.vertices.size());
          for (std::size_t i = 0; i < judge.vertices.size(); ++i) ASSERT_EQ(found.vertices[i], judge.vertices[i]);
          ASSERT_EQ(found.centre, judge.centre);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hl::test_end_places
